// SPDX-License-Identifier: GPL-3.0-or-later
#include "page.hpp"

#include "files.hpp"

#include <fmt/format.h>

#include <array>
#include <stdexcept>

namespace spam::view {
namespace {

/// In the order in which they need each other.
constexpr std::array<std::string_view, 11> scripts{
    "arrays.js", "fields.js",  "motion.js", "colours.js",  "raster.js", "space.js",
    "panels.js", "overlay.js", "curves.js", "controls.js", "player.js"};

/// Between the tags of an element nothing may look like the end of it.
std::string escaped(std::string_view text, char letter, std::string_view instead) {
    std::string result;
    for (const char c : text)
        if (c == letter)
            result += instead;
        else
            result += c;
    return result;
}

void replace(std::string& text, std::string_view mark, std::string_view with) {
    const std::size_t at = text.find(mark);
    if (at == text.npos) throw std::logic_error(fmt::format("page.html has no {}", mark));
    text.replace(at, mark.size(), with);
}

std::string program() {
    std::string all;
    for (const std::string_view script : scripts) all += embedded(script);
    return all;
}

std::string frame() {
    std::string page(embedded("page.html"));
    replace(page, "<!-- A page of spam view -->\n", page_mark.substr(page_mark.find("<!--")));
    replace(page, "/* style */",
            std::string(embedded("uPlot.min.css")) + std::string(embedded("page.css")));
    replace(page, "<!-- licence of uPlot -->", escaped(embedded("LICENSE.uPlot"), '<', "&lt;"));
    replace(page, "/* uPlot */", embedded("uPlot.iife.min.js"));
    replace(page, "/* player */", program());
    return page;
}

}  // namespace

std::size_t bytes_of_program() { return frame().size(); }

std::string make_page(const Payload& payload) {
    std::string page = frame();
    replace(page, "<!-- title -->",
            escaped(escaped(payload.description.value("problem", ""), '&', "&amp;"), '<', "&lt;"));
    std::string blocks;
    std::size_t size = 0;
    for (const std::string& block : payload.blocks) size += block.size() + 60;
    blocks.reserve(size);
    for (std::size_t k = 0; k < payload.blocks.size(); ++k) {
        blocks += fmt::format("<script type=\"text/plain\" id=\"b{}\">", k);
        blocks += payload.blocks[k];
        blocks += "</script>\n";
    }
    // What is not UTF-8 (the name of a folder may be anything) is replaced.
    const std::string description =
        payload.description.dump(-1, ' ', true, nlohmann::json::error_handler_t::replace);
    replace(page, "/* description */", escaped(description, '<', "\\u003c"));
    replace(page, "<!-- blocks -->\n", blocks);
    return page;
}

}  // namespace spam::view
