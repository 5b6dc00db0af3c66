// SPDX-License-Identifier: GPL-3.0-or-later
#include "levels.hpp"
#include "nvector_operations.hpp"
#include <spam/core/nvector.hpp>

#include <nvector/nvector_serial.h>
#include <sundials/sundials_config.h>
#include <sundials/sundials_version.h>

#include <new>
#include <utility>

namespace spam {

SundialsContext::SundialsContext() {
#if SUNDIALS_VERSION_MAJOR >= 7
    const int flag = SUNContext_Create(SUN_COMM_NULL, &context_);
    // Handlers add up there, and the first prints: integrators say themselves what went wrong.
    if (flag == 0) SUNContext_ClearErrHandlers(context_);
#else
    const int flag = SUNContext_Create(nullptr, &context_);
#endif
    if (flag != 0) throw std::bad_alloc();
}

SundialsContext::~SundialsContext() { SUNContext_Free(&context_); }

Vector::Vector(std::size_t size, const SundialsContext& context) {
    N_Vector empty = N_VNewEmpty_Serial(static_cast<sunindextype>(size), context.get());
    if (empty == nullptr) throw std::bad_alloc();
    at_level(instruction_set(), [&](auto level) { use_operations<level>(empty); });
    v_ = N_VClone(empty);
    N_VDestroy(empty);
    if (v_ == nullptr) throw std::bad_alloc();
    N_VConst(0.0, v_);
}

Vector::~Vector() {
    if (v_ != nullptr) N_VDestroy(v_);
}

Vector::Vector(Vector&& other) noexcept : v_(std::exchange(other.v_, nullptr)) {}

Vector& Vector::operator=(Vector&& other) noexcept {
    std::swap(v_, other.v_);
    return *this;
}

Vector Vector::clone() const {
    N_Vector copy = N_VClone(v_);
    if (copy == nullptr) throw std::bad_alloc();
    return Vector(copy);
}

std::size_t Vector::size() const { return static_cast<std::size_t>(N_VGetLength(v_)); }
std::span<double> Vector::span() { return entries(v_); }
std::span<const double> Vector::span() const { return entries(v_); }

std::string sundials_version() {
    int major = 0, minor = 0, patch = 0;
    char label[32] = {};
    SUNDIALSGetVersionNumber(&major, &minor, &patch, label, sizeof(label));
    return std::to_string(major) + '.' + std::to_string(minor) + '.' + std::to_string(patch);
}

std::span<double> entries(N_Vector v) {
    return {N_VGetArrayPointer(v), static_cast<std::size_t>(N_VGetLength(v))};
}

}  // namespace spam
