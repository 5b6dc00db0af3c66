// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <spam/core/quantity.hpp>
#include <spam/core/tensor.hpp>

#include <array>
#include <cstddef>
#include <string>
#include <string_view>

namespace spam {

/// How many numbers a field holds, and how a rotation, a mirror or an image changes them.
enum class Rank {
    scalar,  ///< 1 number
    vector,  ///< D
    axial,   ///< D (D - 1)/2: one number for each plane of rotation, z in the plane, x y z in space
    symmetric,  ///< D (D + 1)/2, in the order of symmetric_index()
    tensor      ///< D^2, row by row
};

/// Where a field is kept, and how it changes.
enum class Role {
    integrated,  ///< in y, of every particle or element, with a rate
    history,  ///< in y, of every one, rate zero: changed between steps only (a plastic strain, damage)
    account,  ///< in y, of the whole system, with a rate: what externals have given (work, heat, impulse)
    memory,    ///< beside y (core/memory.hpp), changed between steps only: material vectors, heat
    constant,  ///< beside y, found when the law is made, from all particles
    derived  ///< beside y, made anew from the others where these have been read: the age of a list
};

/// What has a field that is no account. Particles and elements may each have one of the same name.
enum class Holder {
    particle,
    element,  ///< between particles, which are its corners: a finite element
    bond,     ///< from a particle to one of its neighbours; memory only
    run       ///< the whole system; memory only
};

/// What a new particle has of the old ones that it is made of.
enum class Share {
    mean,  ///< by mass; positions with the way from the old places to the new one
    sum,   ///< of each as much as goes into it of that particle's mass
    equal  ///< what they have in common; others cannot be one particle
};

/// A field of y or of what is remembered beside it, as its author declares it, once and for good:
///     inline constexpr FieldKind damage{"damage", Rank::scalar, Role::history, "1"};
struct FieldKind {
    std::string_view name;  ///< in messages, checkpoints, snapshots and the options --atol-NAME
    /// How many numbers a particle has of it, and how they turn.
    Rank rank;
    /// How it changes.
    Role role;
    std::string_view unit;  ///< in terms of mass, length, time: "m/l^3"; "1" for a pure number
    int place = 100;        ///< in y: by place, then in the order in which a model names them
    /// Without it the same number in an image, or a vector or tensor that turns with the axes.
    Quantity quantity = Quantity::scalar;
    Share share = Share::mean;  ///< where particles are split and merged
};

/// A field, by its kind. Two of the same name are the same.
class Field {
  public:
    /// The field that `kind` declares; `kind` must live as long as the program.
    constexpr Field(const FieldKind& kind) : kind_(&kind) {}  // NOLINT: a kind is a field

    /// As in messages, checkpoints, snapshots and options --atol-NAME.
    constexpr std::string_view name() const { return kind_->name; }
    /// How many numbers it holds, and how they turn.
    constexpr Rank rank() const { return kind_->rank; }
    /// In y or beside it, and how it changes.
    constexpr Role role() const { return kind_->role; }
    /// What images of a particle make of it.
    constexpr Quantity quantity() const { return kind_->quantity; }
    /// Where particles are split and merged.
    constexpr Share share() const { return kind_->share; }
    /// In terms of mass m, length l and time t; "1" for a pure number.
    constexpr std::string_view unit() const { return kind_->unit; }
    /// Its place in y: fields lie in ascending order.
    constexpr int place() const { return kind_->place; }

    /// Numbers per particle (or of an account) in Dim dimensions.
    template <int Dim>
    constexpr std::size_t components() const {
        switch (rank()) {
            case Rank::vector:
                return Dim;
            case Rank::axial:
                return Dim * (Dim - 1) / 2;
            case Rank::symmetric:
                return static_cast<std::size_t>(symmetric_size(Dim));
            case Rank::tensor:
                return Dim * Dim;
            case Rank::scalar:
                break;
        }
        return 1;
    }

    /// "_x", "_xy", nothing for a scalar: the suffix of one component in names of columns.
    template <int Dim>
    std::string suffix(std::size_t component) const {
        constexpr std::string_view axes = "xyz";
        if (rank() == Rank::scalar || (rank() == Rank::axial && Dim < 3)) return {};
        if (rank() == Rank::vector || rank() == Rank::axial) return {'_', axes[component]};
        for (std::size_t a = 0; a < Dim; ++a)
            for (std::size_t b = 0; b < Dim; ++b) {
                const std::size_t at = rank() == Rank::tensor
                                           ? a * Dim + b
                                           : static_cast<std::size_t>(symmetric_index(
                                                 Dim, static_cast<int>(a), static_cast<int>(b)));
                if ((rank() == Rank::tensor || a <= b) && at == component)
                    return {'_', axes[a], axes[b]};
            }
        return {};
    }

    friend constexpr bool operator==(const Field& a, const Field& b) {
        return a.name() == b.name();
    }
    /// Whether both were declared by the same FieldKind.
    constexpr bool same_kind(const Field& other) const { return kind_ == other.kind_; }

    /// Those that most models carry; declared with their ranks and units in field_kind.
    static const Field position, velocity, density, stress, energy;
    /// Accounts: what externals have given to all particles since the start.
    static const Field work, heat, impulse, angular_impulse;
    /// What the wall across direction a, the lower or the upper one, has given to the particles: parts of
    /// `heat`, `work` and `impulse`.
    static constexpr Field wall_heat(int a, bool upper);
    static constexpr Field wall_work(int a, bool upper);     ///< see wall_heat()
    static constexpr Field wall_impulse(int a, bool upper);  ///< see wall_heat()

  private:
    const FieldKind* kind_;
};

namespace field_kind {
inline constexpr FieldKind position{"position", Rank::vector,      Role::integrated, "l",
                                    0,          Quantity::position};
inline constexpr FieldKind velocity{"velocity", Rank::vector,      Role::integrated, "l/t",
                                    1,          Quantity::velocity};
inline constexpr FieldKind density{"density", Rank::scalar, Role::integrated, "m/l^D", 2};
inline constexpr FieldKind stress{"stress", Rank::symmetric, Role::integrated, "m l^(2-D)/t^2",
                                  3,        Quantity::stress};
inline constexpr FieldKind energy{"energy", Rank::scalar, Role::integrated, "l^2/t^2", 4};
inline constexpr FieldKind work{"work", Rank::scalar, Role::account, "m l^2/t^2", 200};
inline constexpr FieldKind heat{"heat", Rank::scalar, Role::account, "m l^2/t^2", 201};
inline constexpr FieldKind impulse{"impulse", Rank::vector, Role::account, "m l/t", 202};
inline constexpr FieldKind angular_impulse{"angular_impulse", Rank::axial, Role::account, "m l^2/t",
                                           203};
/// Through or by one side of the box, [2 direction + (1 for the upper one)].
inline constexpr std::array wall_heat{
    FieldKind{"heat_left", Rank::scalar, Role::account, "m l^2/t^2", 204},
    FieldKind{"heat_right", Rank::scalar, Role::account, "m l^2/t^2", 205},
    FieldKind{"heat_bottom", Rank::scalar, Role::account, "m l^2/t^2", 206},
    FieldKind{"heat_top", Rank::scalar, Role::account, "m l^2/t^2", 207},
    FieldKind{"heat_front", Rank::scalar, Role::account, "m l^2/t^2", 208},
    FieldKind{"heat_back", Rank::scalar, Role::account, "m l^2/t^2", 209}};
inline constexpr std::array wall_work{
    FieldKind{"work_left", Rank::scalar, Role::account, "m l^2/t^2", 210},
    FieldKind{"work_right", Rank::scalar, Role::account, "m l^2/t^2", 211},
    FieldKind{"work_bottom", Rank::scalar, Role::account, "m l^2/t^2", 212},
    FieldKind{"work_top", Rank::scalar, Role::account, "m l^2/t^2", 213},
    FieldKind{"work_front", Rank::scalar, Role::account, "m l^2/t^2", 214},
    FieldKind{"work_back", Rank::scalar, Role::account, "m l^2/t^2", 215}};
inline constexpr std::array wall_impulse{
    FieldKind{"impulse_left", Rank::vector, Role::account, "m l/t", 216},
    FieldKind{"impulse_right", Rank::vector, Role::account, "m l/t", 217},
    FieldKind{"impulse_bottom", Rank::vector, Role::account, "m l/t", 218},
    FieldKind{"impulse_top", Rank::vector, Role::account, "m l/t", 219},
    FieldKind{"impulse_front", Rank::vector, Role::account, "m l/t", 220},
    FieldKind{"impulse_back", Rank::vector, Role::account, "m l/t", 221}};
}  // namespace field_kind

inline constexpr Field Field::position{field_kind::position};  ///< never wrapped
inline constexpr Field Field::velocity{field_kind::velocity};  ///< v, not the averaged one
inline constexpr Field Field::density{field_kind::density};    ///< by continuity
inline constexpr Field Field::stress{field_kind::stress};      ///< tension positive
inline constexpr Field Field::energy{field_kind::energy};      ///< internal, by mass
inline constexpr Field Field::work{field_kind::work};        ///< done on the particles by externals
inline constexpr Field Field::heat{field_kind::heat};        ///< given to them by externals
inline constexpr Field Field::impulse{field_kind::impulse};  ///< time integral of external forces
inline constexpr Field Field::angular_impulse{field_kind::angular_impulse};  ///< of their torques

inline constexpr Field Field::wall_heat(int a, bool upper) {
    return field_kind::wall_heat[static_cast<std::size_t>(2 * a + (upper ? 1 : 0))];
}
inline constexpr Field Field::wall_work(int a, bool upper) {
    return field_kind::wall_work[static_cast<std::size_t>(2 * a + (upper ? 1 : 0))];
}
inline constexpr Field Field::wall_impulse(int a, bool upper) {
    return field_kind::wall_impulse[static_cast<std::size_t>(2 * a + (upper ? 1 : 0))];
}

/// The fields that have options of their own (--atol-NAME) and columns in the studies of integrators.
inline constexpr std::array integrated_fields{Field::position, Field::velocity, Field::density,
                                              Field::stress, Field::energy};

}  // namespace spam
