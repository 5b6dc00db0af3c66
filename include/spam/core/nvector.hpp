// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <sundials/sundials_context.h>
#include <sundials/sundials_nvector.h>

#include <cstddef>
#include <span>
#include <string>

/// Ownership of SUNDIALS objects. SUNDIALS is called here and in src/integrate only.
namespace spam {

/// A SUNDIALS context: one for each run, never shared between threads.
class SundialsContext {
  public:
    SundialsContext();
    ~SundialsContext();
    SundialsContext(const SundialsContext&) = delete;
    SundialsContext& operator=(const SundialsContext&) = delete;
    SUNContext get() const { return context_; }

  private:
    SUNContext context_ = nullptr;
};

/// One contiguous vector of doubles that SUNDIALS can integrate. Owns its N_Vector; movable, not
/// copyable (use clone()). The only place where a kind of N_Vector (serial, OpenMP, MPI) is chosen.
/// Throws std::bad_alloc when memory runs out.
class Vector {
  public:
    Vector(std::size_t size, const SundialsContext& context);  ///< all zero
    ~Vector();
    Vector(Vector&& other) noexcept;
    Vector& operator=(Vector&& other) noexcept;
    Vector(const Vector&) = delete;
    Vector& operator=(const Vector&) = delete;

    Vector clone() const;  ///< same size, contents not copied
    N_Vector get() const { return v_; }
    std::size_t size() const;
    std::span<double> span();
    std::span<const double> span() const;

  private:
    explicit Vector(N_Vector v) : v_(v) {}
    N_Vector v_ = nullptr;
};

/// "6.4.1": the library in use.
std::string sundials_version();

/// Entries of any contiguous N_Vector.
std::span<double> entries(N_Vector v);

}  // namespace spam
