# SPDX-License-Identifier: GPL-3.0-or-later
"""Plane finite elements of solids and fluids from Python."""
import unittest

import numpy as np
import spam_mechanics as spam
import compiled  # noqa: F401: skips where it is not built


def water(limit=None):
    return spam.Fluid(spam.EmbeddedAtom(tension_limit=limit))


class Elements(unittest.TestCase):
    def test_a_cold_fluid_holds_nothing_but_its_nodes(self):
        x, corners = spam.rectangle_mesh(6, 4)
        model = spam.Elements(x, corners, material=water())
        self.assertEqual(set(model.fields), {"position", "velocity"})
        y = model.start()
        y[:2 * len(x)] = 0.9 * x[model.id].ravel()  # pushed together
        fields = spam.element_fields(model, y)
        rho = 1.0 / 0.81
        np.testing.assert_allclose(fields["density"], rho, rtol=1e-14)
        np.testing.assert_allclose(fields["energy"], 0.5 * (rho - 1.0)**2, rtol=1e-13)
        P = rho**3 - rho**2
        np.testing.assert_allclose(fields["stress"], np.tile([-P, -P, 0.0], (24, 1)), atol=1e-14)
        sim = spam.Simulation(model, velocity=0.05 * np.sin(x), method="leapfrog", dt=0.05)
        run = sim.run(5.0)
        self.assertTrue(run.drifts["momentum"].kept)
        self.assertLess(run.drifts["angular momentum"].change, 1e-12)

    def test_solids_and_fluids_between_guides(self):
        x, corners = spam.rectangle_mesh(9, 6)
        matter = [water(0.1), spam.ElasticSolid.triangular_lattice(), spam.Fluid(spam.GammaGas(1.4), eta=0.1)]
        floor, wall = np.flatnonzero(x[:, 1] < -2.9), np.flatnonzero(np.abs(x[:, 0]) > 4.4)
        model = spam.Elements(x, corners, material=matter, which=np.arange(54) % 3, density=[1.0, 1.2, 0.5],
                              temperature=[0.0, 0.0, 0.3], hourglass_viscosity=0.1, held_x=wall, held_y=floor,
                              externals=[spam.Gravity([0.0, -0.01])])
        self.assertAlmostEqual(model.mass.sum(), 18 * (1.0 + 1.2 + 0.5))
        self.assertAlmostEqual(spam.element_fields(model, model.start())["energy"][2], 0.3 / 0.4)
        self.assertAlmostEqual(spam.element_fields(model, model.start(temperature=0.5))["energy"][2], 0.5 / 0.4)
        sim = spam.Simulation(model, dt=0.02)
        run = sim.run(3.0)
        self.assertTrue(all(drift.kept for drift in run.drifts.values()), run.drifts)
        moved = sim.by_id("position") - x
        self.assertEqual(np.abs(moved[wall, 0]).max(), 0.0)
        self.assertEqual(np.abs(moved[floor, 1]).max(), 0.0)
        self.assertGreater(np.abs(moved[wall, 1]).max(), 0.0)
        self.assertGreater(np.abs(moved[floor, 0]).max(), 0.0)

    def test_what_makes_no_sense_is_refused_in_one_line(self):
        x, corners = spam.rectangle_mesh(3, 2)
        gas = spam.GammaGas(1.4)
        for words, wrong in (
                ("corners", {"corners": corners[:, :3]}),
                ("corners", {"corners": corners + 100}),
                ("corners", {"corners": corners[:, ::-1]}),
                ("corners", {"corners": 0.5 * corners}),
                ("density", {"density": [1.0, 2.0]}),
                ("density", {"density": -1.0}),
                ("which", {"which": [0, 0, 0, 0, 0, 3]}),
                ("which", {"which": [0]}),
                ("held_y", {"held_y": [99]}),
                ("spacing", {"spacing": 0.0}),
                ("temperature", {"material": spam.Fluid(gas), "hourglass_viscosity": 0.1}),
                ("conductivity", {"material": spam.Fluid(gas, kappa=1.0)}),
                ("gradients", {"material": spam.Fluid(gas, eta=1.0, by_pairs=True)}),
        ):
            keywords = {"corners": corners, "material": water(), **wrong}
            with self.assertRaisesRegex(spam.InputError, words) as refused:
                spam.Elements(x, **keywords)
            self.assertNotIn("\n", str(refused.exception))
        with self.assertRaisesRegex(spam.InputError, "no elements"):
            model = spam.SmoothParticles(x)
            spam.element_fields(model, model.start())


if __name__ == "__main__":
    unittest.main()
