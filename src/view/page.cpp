// SPDX-License-Identifier: GPL-3.0-or-later
#include "page.hpp"

#include "files.hpp"

#include <fmt/format.h>

#include <array>
#include <initializer_list>
#include <stdexcept>
#include <utility>

namespace spam::view {
namespace {

/// In the order in which they need each other.
constexpr std::array<std::string_view, 11> scripts{
    "arrays.js", "fields.js",  "motion.js", "colours.js",  "raster.js", "space.js",
    "panels.js", "overlay.js", "curves.js", "controls.js", "player.js"};

std::string as_text(std::string_view text) {
    std::string result;
    for (const char c : text)
        if (c == '<')
            result += "&lt;";
        else if (c == '&')
            result += "&amp;";
        else
            result += c;
    return result;
}

/// page.html with texts in place of its marks, given in their order. What has been put in is not looked at again:
/// it may hold marks itself.
std::string assembled(std::initializer_list<std::pair<std::string_view, std::string_view>> parts) {
    const std::string_view frame = embedded("page.html");
    std::size_t size = frame.size(), at = 0;
    for (const auto& [mark, text] : parts) size += text.size();
    std::string page;
    page.reserve(size);
    for (const auto& [mark, text] : parts) {
        const std::size_t found = frame.find(mark, at);
        if (found == frame.npos) throw std::logic_error(fmt::format("page.html has no {}", mark));
        page += frame.substr(at, found - at);
        page += text;
        at = found + mark.size();
    }
    return page += frame.substr(at);
}

std::string program() {
    std::string all;
    for (const std::string_view script : scripts) all += embedded(script);
    return all;
}

std::string page_of(std::string_view title, std::string_view blocks, std::string_view description) {
    return assembled({{"<!-- A page of spam view -->\n", page_mark.substr(page_mark.find("<!--"))},
                      {"<!-- title -->", as_text(title)},
                      {"/* style */",
                       std::string(embedded("uPlot.min.css")) + std::string(embedded("page.css"))},
                      {"<!-- licence of uPlot -->", as_text(embedded("LICENSE.uPlot"))},
                      {"<!-- blocks -->\n", blocks},
                      {"/* description */", description},
                      {"/* uPlot */", embedded("uPlot.iife.min.js")},
                      {"/* player */", program()}});
}

}  // namespace

std::size_t bytes_of_program() { return page_of("", "", "").size(); }

std::string make_page(const Payload& payload) {
    std::string blocks;
    std::size_t size = 0;
    for (const std::string& block : payload.blocks) size += block.size() + 60;
    blocks.reserve(size);
    for (std::size_t k = 0; k < payload.blocks.size(); ++k) {
        blocks += fmt::format("<script type=\"text/plain\" id=\"b{}\">", k);
        blocks += payload.blocks[k];
        blocks += "</script>\n";
    }
    return page_of(payload.description.value("problem", ""), blocks, in_page(payload.description));
}

}  // namespace spam::view
