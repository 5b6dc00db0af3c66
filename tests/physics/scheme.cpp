// SPDX-License-Identifier: GPL-3.0-or-later
#include <spam/core/error.hpp>
#include <spam/physics/scheme.hpp>

#include <boost/test/unit_test.hpp>

#include <cmath>

using namespace spam;

BOOST_AUTO_TEST_CASE(combinations_without_meaning_are_refused) {
    BOOST_CHECK_THROW((Scheme{.density = Density::chain_rule}.validate(2)), InputError);
    BOOST_CHECK_NO_THROW((Scheme{.angular_momentum = AngularMomentum::torque_pair}.validate(3)));
    BOOST_CHECK_THROW((Scheme{.angular_momentum = AngularMomentum::torque_pair}.validate(1)),
                      InputError);
    BOOST_CHECK_THROW((Scheme{.range = 0.0}.validate(2)), InputError);
    BOOST_CHECK_THROW((Scheme{.range = -3.0}.validate(2)), InputError);
    BOOST_CHECK_THROW((Scheme{.closest_approach = -0.5}.validate(2)), InputError);
    BOOST_CHECK_THROW((Scheme{.closest_approach = std::nan("")}.validate(2)), InputError);
    BOOST_CHECK_THROW((Scheme{.closest_approach = HUGE_VAL}.validate(2)), InputError);
    BOOST_CHECK_NO_THROW(
        (Scheme{.density = Density::chain_rule, .transport = Transport::average}.validate(3)));
}

BOOST_AUTO_TEST_CASE(work_of_the_own_stress_is_refused_where_forces_belong_to_none) {
    const Scheme own{.work = Work::own};
    for (const int dim : {1, 2, 3}) BOOST_CHECK_NO_THROW(own.validate(dim));
    Scheme scheme = own;
    scheme.angular_momentum = AngularMomentum::gauss;  // keeps the energy by itself
    BOOST_CHECK_NO_THROW(scheme.validate(2));
    for (const auto law : {AngularMomentum::torque_pair, AngularMomentum::torque_particle}) {
        scheme.angular_momentum = law;
        BOOST_CHECK_THROW(scheme.validate(2), InputError);
    }
    scheme = own;
    scheme.transport = Transport::shifting;
    BOOST_CHECK_THROW(scheme.validate(2), InputError);
    BOOST_TEST((own.describe().find("work of the own pressure") != std::string::npos));
    BOOST_TEST((Scheme{}.describe().find("work") == std::string::npos));
    BOOST_TEST((own.promises(2).energy == Promise::integrator_error));
}

BOOST_AUTO_TEST_CASE(shifting_goes_with_few_others) {
    const Scheme shifted{.transport = Transport::shifting};
    BOOST_CHECK_NO_THROW(shifted.validate(1));
    BOOST_CHECK_NO_THROW(shifted.validate(3));
    for (const double strength : {0.0, -1.0, std::nan(""), HUGE_VAL}) {
        Scheme scheme = shifted;
        scheme.shifting = strength;
        BOOST_CHECK_THROW(scheme.validate(2), InputError);
        scheme.transport = Transport::plain;  // it is not read
        BOOST_CHECK_NO_THROW(scheme.validate(2));
    }
    Scheme scheme = shifted;
    scheme.density = Density::chain_rule;
    BOOST_CHECK_THROW(scheme.validate(2), InputError);
    scheme = shifted;
    scheme.angular_momentum = AngularMomentum::torque_pair;
    BOOST_CHECK_THROW(scheme.validate(2), InputError);
    scheme = shifted;
    scheme.closest_approach = 0.7;
    BOOST_CHECK_THROW(scheme.validate(2), InputError);
    BOOST_TEST((shifted.promises(2).angular_momentum == Promise::not_kept));
    BOOST_TEST((shifted.describe().find("shifting of strength 1,") != std::string::npos));
}

BOOST_AUTO_TEST_CASE(promises_follow_the_scheme) {
    const Scheme free{}, balanced{.angular_momentum = AngularMomentum::torque_pair};
    BOOST_TEST((free.promises(2).angular_momentum == Promise::not_kept));
    BOOST_TEST((free.promises(3).angular_momentum == Promise::not_kept));
    BOOST_TEST((balanced.promises(2).angular_momentum == Promise::integrator_error));
    BOOST_TEST((balanced.promises(2).momentum == Promise::exact));
    BOOST_TEST((free.promises(2).energy == Promise::integrator_error));
}

BOOST_AUTO_TEST_CASE(description_names_every_choice) {
    const std::string words = Scheme{.density = Density::summed,
                                     .transport = Transport::monaghan,
                                     .mean_density = MeanDensityKind::geometric,
                                     .angular_momentum = AngularMomentum::torque_pair,
                                     .range = 2.5}
                                  .describe();
    for (const char* word : {"summed", "monaghan", "geometric", "torque_pair", "lucy", "2.5"})
        BOOST_TEST((words.find(word) != std::string::npos), word << " in " << words);
    BOOST_TEST((words.find("reflected") == std::string::npos));  // said only where it is chosen
    BOOST_TEST((Scheme{.closest_approach = 0.75}.describe().find("reflected at 0.75") !=
                std::string::npos));
}
