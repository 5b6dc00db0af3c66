// SPDX-License-Identifier: GPL-3.0-or-later
#include "support/oracle_model.hpp"

#include "support/oracle_weight.hpp"

#include <Eigen/Eigenvalues>
#include <Eigen/Geometry>

#include <numbers>

namespace spam::test {

namespace {

/// A^-1 b of a symmetric A, 0 along axes of which A knows nothing.
Eigen::Vector3d solved(const Eigen::Matrix3d& A, const Eigen::Vector3d& b) {
    const Eigen::SelfAdjointEigenSolver<Eigen::Matrix3d> axes(A);
    Eigen::Vector3d x = Eigen::Vector3d::Zero();
    for (int k = 0; k < 3; ++k)
        if (std::abs(axes.eigenvalues()[k]) > 1e-12 * A.norm())
            x += axes.eigenvectors().col(k) *
                 (axes.eigenvectors().col(k).dot(b) / axes.eigenvalues()[k]);
    return x;
}

template <int Dim>
class OracleModel final : public Model<Dim> {
    using V = Point<Dim>;
    using M = Eigen::Matrix<double, Dim, Dim>;

  public:
    OracleModel(Particles<Dim> particles, const ElasticSolid& law, const Scheme& scheme,
                Mutation mutation)
        : Model<Dim>(std::move(particles), {}, fields(scheme)),
          law_(law),
          scheme_(scheme),
          mutation_(mutation) {}

    void rates(double, std::span<const double> y, std::span<double> y_dot) override {
        load(y);
        transport();
        const State<Dim> rate(this->layout(), y_dot);
        Eigen::MatrixXd stress_dot(symmetric_size(Dim), n_);
        for (int i = 0; i < n_; ++i) {
            rate.position().col(i) = u_[at(i)];
            M G = M::Zero();
            double rho_dot = 0.0;
            for (int j = 0; j < n_; ++j) {
                if (skip(i, j)) continue;
                const V g = gradient(i, j);
                const double sign = mutation_ == Mutation::printed_gradient ? -1.0 : 1.0;
                G += sign * m(j) / mean(i, j) * g * (v_[at(j)] - v_[at(i)]).transpose();
                const bool chain = scheme_.density == Density::chain_rule;
                const V w = chain ? V(u_[at(i)] - u_[at(j)]) : V(v_[at(i)] - v_[at(j)]);
                rho_dot += m(j) * w.dot(g);
            }
            if (rate.has(Field::density)) rate.density()(0, i) = rho_dot;
            store_stress(rate, i, stress_rate(G, stress_[at(i)]));
        }
        forces(rate);
        if (scheme_.angular_momentum == AngularMomentum::gauss) gauss(rate);
    }

    double internal_energy(std::span<const double>) const override { return 0.0; }
    Promises promises() const override { return scheme_.promises(Dim); }
    std::string describe() const override { return "oracle"; }
    std::size_t pairs() const override { return 0; }
    double reach() const override { return scheme_.range; }

  private:
    using Axial = Eigen::Vector3d;

    static std::vector<Field> fields(const Scheme& s) {
        std::vector<Field> f{Field::position, Field::velocity, Field::stress, Field::energy};
        if (s.density != Density::summed) f.push_back(Field::density);
        return f;
    }
    static std::size_t at(int i) { return static_cast<std::size_t>(i); }
    double m(int i) const { return this->particles().mass[at(i)]; }
    bool skip(int i, int j) const { return mutation_ == Mutation::half_list && j < i; }

    OracleWeight<Dim> w() const {
        return {mutation_ == Mutation::lucys_weight ? Kernel::lucy : scheme_.kernel, scheme_.range};
    }
    double weight(double r) const { return w().value(r); }
    V gradient(int i, int j) const {
        const V r = x_[at(i)] - x_[at(j)];
        const double h = scheme_.range, d = r.norm();
        if (d >= h || d == 0.0) return V::Zero();
        return w().slope(d) / d * r;
    }
    double mean(int i, int j) const {
        return scheme_.mean_density == MeanDensityKind::arithmetic
                   ? 0.5 * (rho_[at(i)] + rho_[at(j)])
                   : std::sqrt(rho_[at(i)] * rho_[at(j)]);
    }
    V force(int i, int j) const {  // of j on i, times nothing: for unit masses
        const M A =
            stress_[at(i)] / std::pow(rho_[at(i)], 2) + stress_[at(j)] / std::pow(rho_[at(j)], 2);
        V f = A * gradient(i, j);
        if (scheme_.viscosity > 0.0) f -= viscosity(i, j) * gradient(i, j);
        if (mutation_ == Mutation::absolute_position) f *= 1.0 + 0.01 * x_[at(i)][0] * x_[at(j)][0];
        return f;
    }
    /// In space, where a plane or a line lies.
    static Axial in_space(const V& a) {
        Axial r = Axial::Zero();
        r.head<Dim>() = a;
        return r;
    }
    static Axial cross(const V& a, const V& b) { return in_space(a).cross(in_space(b)); }

    void load(std::span<const double> y) {
        const ConstState<Dim> state(this->layout(), y);
        n_ = static_cast<int>(this->particles().size());
        if (c_L_ == 0.0) c_L_ = sound_speed();
        x_.assign(at(n_), V::Zero());
        v_ = u_ = x_;
        rho_.assign(at(n_), 0.0);
        stress_.assign(at(n_), M::Zero());
        for (int i = 0; i < n_; ++i) {
            x_[at(i)] = state.position().col(i);
            v_[at(i)] = state.velocity().col(i);
            for (int a = 0; a < Dim; ++a)
                for (int b = 0; b < Dim; ++b)
                    stress_[at(i)](a, b) =
                        state.stress()(symmetric_index(Dim, std::min(a, b), std::max(a, b)), i);
        }
        for (int i = 0; i < n_; ++i) {
            if (state.has(Field::density))
                rho_[at(i)] = state.density()(0, i);
            else
                for (int j = 0; j < n_; ++j)
                    rho_[at(i)] += m(j) * weight((x_[at(i)] - x_[at(j)]).norm());
        }
    }

    void transport() {
        for (int i = 0; i < n_; ++i) {
            V momentum = V::Zero(), correction = V::Zero();
            double sum = 0.0;
            for (int j = 0; j < n_; ++j) {
                const double mw = m(j) * weight((x_[at(i)] - x_[at(j)]).norm());
                momentum += mw * v_[at(j)];
                sum += mw;
                correction += mw / mean(i, j) * (v_[at(j)] - v_[at(i)]);
            }
            u_[at(i)] = v_[at(i)];
            if (mutation_ == Mutation::printed_average) sum = rho_[at(i)];
            if (scheme_.transport == Transport::average) u_[at(i)] = momentum / sum;
            if (scheme_.transport == Transport::monaghan) u_[at(i)] += correction;
        }
    }

    M stress_rate(const M& G, const M& s) const {  // G_ab = d v_b / d x_a
        M rate = law_.lambda * G.trace() * M::Identity() + law_.eta * (G + G.transpose());
        if (mutation_ == Mutation::anisotropic) rate(0, 0) += 0.1 * law_.eta * G(0, 0);
        const M W = 0.5 * (G.transpose() - G) * (mutation_ == Mutation::reversed_spin ? -1.0 : 1.0);
        return rate + W * s - s * W;
    }
    void store_stress(const State<Dim>& rate, int i, const M& s) const {
        for (int a = 0; a < Dim; ++a)
            for (int b = a; b < Dim; ++b) rate.stress()(symmetric_index(Dim, a, b), i) = s(a, b);
    }

    /// c_L at the mean summed density of the reference configuration.
    double sound_speed() const {
        const auto& X = this->particles().reference_position;
        double rho = 0.0;
        for (int k = 0; k < n_; ++k)
            for (int l = 0; l < n_; ++l) rho += m(l) * weight((X.col(k) - X.col(l)).norm()) / n_;
        return std::sqrt((law_.lambda + 2.0 * law_.eta) / rho);
    }
    double viscosity(int i, int j) const {  // Pi_ij
        const double c = c_L_, l = scheme_.range / 2.0;
        const V r = x_[at(i)] - x_[at(j)], v = v_[at(i)] - v_[at(j)];
        if (r.dot(v) >= 0.0 && mutation_ != Mutation::viscous_recession) return 0.0;
        const double mu = l * r.dot(v) / (r.squaredNorm() + 0.01 * l * l);
        return scheme_.viscosity * (-c * mu + 2.0 * mu * mu) / mean(i, j);
    }

    bool in(int i, int group) const {
        return scheme_.balance == Balance::global || this->particles().body[at(i)] == group;
    }
    int groups() const {
        return scheme_.balance == Balance::global ? 1 : this->particles().bodies();
    }

    Axial torque(int i, int j) const {
        return m(i) * m(j) * cross(x_[at(i)] - x_[at(j)], force(i, j));
    }
    Axial torque(int i) const {
        Axial T = Axial::Zero();
        for (int j = 0; j < n_; ++j) T += 0.5 * torque(i, j);
        return T;
    }
    static double factor(const Axial& T, const Axial& theta) {
        return T.isZero(0.0) ? 1.0 : std::exp(-theta.dot(T.normalized()));
    }

    /// theta of every group, where sum |T| exp(-theta.n) - theta.X is least, X = sum m u x v, by Newton's method. In
    /// the plane e^theta is the R of [HHM04] VIII.
    std::vector<Axial> multipliers() const {
        std::vector<Axial> all;
        for (int group = 0; group < groups(); ++group) {
            std::vector<Axial> torques;
            Axial X = Axial::Zero();
            for (int i = 0; i < n_; ++i) {
                if (!in(i, group)) continue;
                if (mutation_ != Mutation::without_X) X += m(i) * cross(u_[at(i)], v_[at(i)]);
                if (scheme_.angular_momentum == AngularMomentum::torque_particle)
                    torques.push_back(torque(i));
                else
                    for (int j = 0; j < n_; ++j) torques.push_back(0.5 * torque(i, j));
            }
            if (scheme_.transport != Transport::average) X.setZero();
            Axial theta = Axial::Zero();
            for (int k = 0; k < 60; ++k) {
                Axial rest = X;
                Eigen::Matrix3d H = Eigen::Matrix3d::Zero();
                for (const Axial& T : torques) {
                    if (T.isZero(0.0)) continue;
                    rest += factor(T, theta) * T;
                    H += factor(T, theta) * T * T.transpose() / T.norm();
                }
                const Axial step = solved(H, rest);
                theta += step / std::max(1.0, 2.0 * step.norm());
            }
            all.push_back(theta);
        }
        return all;
    }
    Axial of_group(int i, const std::vector<Axial>& theta) const {
        return theta[scheme_.balance == Balance::global ? 0 : at(this->particles().body[at(i)])];
    }

    void forces(const State<Dim>& rate) const {
        const bool balance = scheme_.angular_momentum == AngularMomentum::torque_pair ||
                             scheme_.angular_momentum == AngularMomentum::torque_particle;
        const auto theta = balance ? multipliers() : std::vector<Axial>{};
        const bool particle = scheme_.angular_momentum == AngularMomentum::torque_particle;
        std::vector<double> own;  // factors of particles
        for (int i = 0; i < n_ && balance && particle; ++i)
            own.push_back(factor(torque(i), of_group(i, theta)));
        for (int i = 0; i < n_; ++i) {
            V v_dot = V::Zero();
            double e_dot = 0.0;
            for (int j = 0; j < n_; ++j) {
                if (j == i || skip(i, j)) continue;
                const V before = force(i, j);
                V f = before;
                if (balance) {
                    const V r = x_[at(i)] - x_[at(j)];
                    const Axial T = cross(r, f);
                    const double s =
                        particle
                            ? 0.5 * (own[at(i)] + own[at(j)])
                            : 0.5 * (factor(T, of_group(i, theta)) + factor(T, of_group(j, theta)));
                    f += (s - 1.0) / r.squaredNorm() * T.cross(in_space(r)).template head<Dim>();
                }
                v_dot += m(j) * f;
                const V& working = mutation_ == Mutation::work_before_scaling ? before : f;
                e_dot -= (mutation_ == Mutation::full_work ? 1.0 : 0.5) * m(j) *
                         working.dot(v_[at(i)] - v_[at(j)]);
            }
            rate.velocity().col(i) = v_dot;
            rate.energy()(0, i) = e_dot;
        }
    }

    /// [HHM04] VII with the multipliers derived again.
    void gauss(const State<Dim>& rate) const {
        for (int group = 0; group < groups(); ++group) {
            double mass = 0.0, K = 0.0;
            Eigen::Matrix3d I = Eigen::Matrix3d::Zero();
            Axial L = Axial::Zero(), L_dot = L;
            V X = V::Zero(), U = V::Zero(), transport = V::Zero();
            for (int i = 0; i < n_; ++i)
                if (in(i, group)) {
                    mass += m(i);
                    X += m(i) * x_[at(i)];
                    U += m(i) * v_[at(i)];
                    transport += m(i) * u_[at(i)];
                }
            X /= mass;
            U /= mass;
            transport /= mass;
            for (int i = 0; i < n_; ++i)
                if (in(i, group)) {
                    const V r = x_[at(i)] - X, v = v_[at(i)] - U;
                    I += m(i) * (r.squaredNorm() * Eigen::Matrix3d::Identity() -
                                 in_space(r) * in_space(r).transpose());
                    L += m(i) * cross(r, v);
                    K += m(i) * v.squaredNorm() / 2.0;
                    L_dot += m(i) * (cross(V(u_[at(i)] - transport), v) +
                                     cross(r, V(rate.velocity().col(i))));
                }
            const Eigen::Matrix3d reduced = I - L * L.transpose() / (2.0 * K);
            Axial beta = -solved(reduced, L_dot);
            if (mutation_ == Mutation::printed_multipliers) beta = -beta;
            const double alpha = beta.dot(L) / (2.0 * K);
            if (std::abs(alpha) > solved(I, L).norm()) continue;
            for (int i = 0; i < n_; ++i)
                if (in(i, group))
                    rate.velocity().col(i) +=
                        beta.cross(in_space(V(x_[at(i)] - X))).template head<Dim>() -
                        alpha * (v_[at(i)] - U);
        }
    }

    ElasticSolid law_;
    Scheme scheme_;
    Mutation mutation_;
    int n_ = 0;
    double c_L_ = 0.0;
    std::vector<V> x_, v_, u_;
    std::vector<double> rho_;
    std::vector<M> stress_;
};

}  // namespace

template <int Dim>
std::unique_ptr<Model<Dim>> oracle_model(Particles<Dim> particles, const ElasticSolid& law,
                                         const Scheme& scheme, Mutation mutation) {
    return std::make_unique<OracleModel<Dim>>(std::move(particles), law, scheme, mutation);
}
template std::unique_ptr<Model<1>> oracle_model(Particles<1>, const ElasticSolid&, const Scheme&,
                                                Mutation);
template std::unique_ptr<Model<2>> oracle_model(Particles<2>, const ElasticSolid&, const Scheme&,
                                                Mutation);
template std::unique_ptr<Model<3>> oracle_model(Particles<3>, const ElasticSolid&, const Scheme&,
                                                Mutation);

}  // namespace spam::test
