// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <spam/core/error.hpp>

#include <new>
#include <stdexcept>
#include <string>

namespace spam {

/// Of the exception just caught: why a run that had begun cannot go on, for exit status 3. Empty where that is
/// no matter of the run.
inline std::string why_a_run_stops() {
    try {
        throw;
    } catch (const GuardStop& stop) {
        return stop.what();
    } catch (const InputError& error) {
        return error.what();
    } catch (const std::bad_alloc&) {
        return "not enough memory to go on; the results so far are complete";
    } catch (const std::length_error& error) {
        return std::string("a list would be longer than any memory (") + error.what() +
               "): particles are very far apart, or much farther than their range";
    } catch (...) {
        return {};
    }
}

/// Whether the exception just caught is one that a process meets alone, for want of memory: others know nothing of it.
inline bool is_for_want_of_memory() {
    try {
        throw;
    } catch (const std::bad_alloc&) {
        return true;
    } catch (const std::length_error&) {
        return true;
    } catch (...) {
        return false;
    }
}

}  // namespace spam
