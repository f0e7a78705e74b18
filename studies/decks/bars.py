"""Decks of bars that hit a wall or each other, and what the theory of waves in bars says of them."""

import numpy as np
from comparison import Figure, contact_times
from deck_writer import Deck, card
from radioss_deck import Model

# Steel in kg, mm, ms, and so kN, GPa and J; a bar of 10 by 10 by 500 mm at m/s.
YOUNGS, DENSITY, SIDE, LENGTH = 210.0, 7.85e-6, 10.0, 500.0
WAVE = np.sqrt(210e9 / 7850)  # m/s, of a bar
AREA, METRES = 1e-4, 0.5


class Rod:
    """The rod of Carpenter, Taylor and Katona (1991), elastic, 10 in long, at
    202.2 in/s a hundredth of an inch before a rigid wall. In inches, slinches and seconds, and so lbf."""

    name, units = "rod_on_wall", "in,slinch,s"
    source = "elastic rod on a rigid wall [Carpenter, Taylor and Katona 1991]"

    def deck(self, coarse):
        deck = Deck("a rod on a rigid wall")
        deck.block(1, (0, 0, 0.01), (1, 1, 10.01), (1, 1, 20 if coarse else 100))
        deck.part(1, "rod", 1)
        # Without Poisson's ratio and bulk viscosity, as the problem has it: waves of one dimension, nothing is lost.
        # Zero would mean LS-DYNA's default, which takes 6 % of the energy of so steep a front.
        deck.add("*MAT_ELASTIC", card(1, 7.3e-4, 3.0e7, 0.0), "*CONTROL_BULK_VISCOSITY", card(1e-9, 1e-9))
        deck.add("*RIGIDWALL_PLANAR", card(0, 0, 0))
        deck.add(card(0.0, 0.0, 0.0, 0.0, 0.0, 1.0, 0.0), "*INITIAL_VELOCITY", "", card(0.0, 0.0, -202.2))
        deck.add("*CONTROL_TERMINATION", card(2.5e-4), "*DATABASE_RCFORC", card(1e-7))
        return deck

    def figures(self, results):
        inch, pound = 0.0254, 4.4482216152605
        wave = np.sqrt(3.0e7 / 7.3e-4)  # in/s
        time = results["history/time"][:]
        force = np.abs(results["history/contact/rigid_wall_1_contact/normal_force"][:, 2]) / pound
        kinetic = results["history/energy/kinetic"][:]
        stored = results["history/energy/internal"][:]
        begin, end = contact_times(time, force, 0.01)
        first, lasts = 0.01 / 202.2, 20 / wave
        during = (time > first + 0.25 * lasts) & (time < first + 0.75 * lasts)
        given = 0.5 * 7.3e-4 * 10 * 202.2**2 * pound * inch
        back = results["fields/rod/velocity"][-1][:, 2].mean() / inch
        return [
            Figure("contact force", force[during].mean(), 7.3e-4 * wave * 202.2, "lbf", "rho c A v"),
            Figure("begin of contact", 1e6 * begin, 1e6 * first, "us", "gap / v"),
            Figure("end of contact", 1e6 * end, 1e6 * (first + lasts), "us", "gap / v + 2 L / c"),
            Figure("kinetic energy at the begin", kinetic[0], given, "J", "m v^2 / 2"),
            Figure("elastic energy at most", stored.max(), given, "J", "all of it"),
            Figure("velocity after it", back, 202.2, "in/s", "v"),
        ]


class PlasticBar:
    """A bar of steel that yields at 400 MPa and hardens by a tenth of E, at 20 m/s on a rigid wall. An elastic wave
    goes ahead, a plastic one at sqrt(E_t / rho) follows it (Kolsky 1963)."""

    name, units = "plastic_bar", "mm,kg,ms"
    source = "elastoplastic bar on a rigid wall [Kolsky 1963]"
    yields, tangent, speed = 0.4, 21.0, 20.0  # GPa, GPa, m/s

    def deck(self, coarse):
        deck = Deck("an elastoplastic bar on a rigid wall")
        deck.block(1, (0, 0, 0.001), (SIDE, SIDE, LENGTH + 0.001), (2, 2, 50 if coarse else 200))
        deck.part(1, "bar", 1)
        deck.add("*MAT_PLASTIC_KINEMATIC", card(1, DENSITY, YOUNGS, 0.3, self.yields, self.tangent, 1.0), card(0.0))
        deck.add("*RIGIDWALL_PLANAR", card(0, 0, 0), card(0.0, 0.0, 0.0, 0.0, 0.0, 1.0, 0.0))
        deck.add("*INITIAL_VELOCITY", "", card(0.0, 0.0, -self.speed))
        deck.add("*CONTROL_TERMINATION", card(0.12), "*DATABASE_RCFORC", card(1e-4))
        return deck

    def theory(self):
        """Stress at the wall, Pa; kinetic, elastic and plastic energy when the first wave is at the free end, J."""
        youngs, tangent, yields = 1e9 * YOUNGS, 1e9 * self.tangent, 1e9 * self.yields
        plastic_wave = np.sqrt(tangent / 7850)
        at_yield = yields / (7850 * WAVE)  # the elastic wave takes this of the velocity
        stress = yields + 7850 * plastic_wave * (self.speed - at_yield)
        yielded = METRES * AREA * plastic_wave / WAVE  # volumes
        rest = METRES * AREA - yielded
        kinetic = 0.5 * 7850 * rest * (self.speed - at_yield) ** 2
        elastic = (yielded * stress**2 + rest * yields**2) / (2 * youngs)
        plastic = yielded * (stress**2 - yields**2) / 2 * (1 / tangent - 1 / youngs)
        return stress, kinetic, elastic, plastic

    def figures(self, results):
        stress, kinetic, elastic, plastic = self.theory()
        time = results["history/time"][:]
        force = np.abs(results["history/contact/rigid_wall_1_contact/normal_force"][:, 2])
        there = 1e-6 / self.speed + METRES / WAVE
        during = (time > 0.25 * there) & (time < there)
        energy = {name: results[f"history/energy/{name}"][:] for name in ("kinetic", "internal", "plastic")}
        then = {name: np.interp(there, time, values) for name, values in energy.items()}
        given = 0.5 * 7850 * METRES * AREA * self.speed**2
        return [
            Figure("contact force", force[during].mean() / 1e3, stress * AREA / 1e3, "kN",
                   "A (s_y + rho c_p (v - v_y))"),
            Figure("kinetic energy at the begin", energy["kinetic"][0], given, "J", "m v^2 / 2"),
            Figure("kinetic energy at L / c", then["kinetic"], kinetic, "J",
                   "of what the plastic wave has not reached"),
            Figure("elastic energy at L / c", then["internal"], elastic, "J", "s^2 / 2 E of both parts"),
            Figure("plastic work at L / c", then["plastic"], plastic, "J", "(s^2 - s_y^2) (1 / E_t - 1 / E) / 2"),
        ]


class TaylorBar:
    """Taylor's bar [Kamoulakos 1990]: a copper cylinder of 32.4 by 3.2 mm at 227 m/s on a rigid wall without friction,
    80 us. In g, mm, ms, and so MPa, N and mJ. docs/materials.md has the same as a case, and where the published figures
    are from."""

    name, units = "taylor_bar", "mm,g,ms"
    source = "Taylor's bar on a rigid wall, beside published figures [Kamoulakos 1990]"

    def deck(self, coarse):
        deck = Deck("Taylor's bar")
        core, ring, layers = (4, 2, 27) if coarse else (6, 4, 54)
        deck.cylinder(1, 3.2, (0.0001, 32.4001), core, ring, layers)
        deck.part(1, "bar", 1)
        # H = 100 MPa: E_t = E H / (E + H)
        deck.add("*MAT_PLASTIC_KINEMATIC", card(1, 8.93e-3, 117e3, 0.35, 400.0, 99.9146, 1.0), card(0.0))
        deck.add("*RIGIDWALL_PLANAR", card(0, 0, 0), card(0.0, 0.0, 0.0, 0.0, 0.0, 1.0, 0.0))
        deck.add("*INITIAL_VELOCITY", "", card(0.0, 0.0, -227.0))
        deck.add("*CONTROL_TERMINATION", card(0.08), "*DATABASE_RCFORC", card(1e-3))
        return deck

    def figures(self, results):
        bar = results["fields/bar"]
        before = 1e3 * bar["coordinates"][:]
        after = before + 1e3 * bar["displacement"][-1]
        foot = before[:, 2] < 0.001
        length = after[:, 2].max() - after[foot, 2].min()
        radius = np.hypot(after[foot, 0], after[foot, 1]).max()
        energy = {name: results[f"history/energy/{name}"][:] for name in ("kinetic", "plastic")}
        given = 0.5 * 8930 * np.pi * 0.0032**2 * 0.0324 * 227**2
        return [
            Figure("kinetic energy at the begin", energy["kinetic"][0], given, "J", "m v^2 / 2"),
            Figure("final length", length, 21.445, "mm", "published: 21.42 to 21.47 mm"),
            Figure("radius of the foot", radius, 7.115, "mm", "published: 7.02 to 7.21 mm"),
        ]


class TwoBars:
    """Two equal elastic bars; one strikes the other at 10 m/s."""

    name, units = "two_bars", "mm,kg,ms"
    source = "two elastic bars meet [Kolsky 1963]"
    speed = 10.0
    radioss = Model(("kg", "mm", "ms"), DENSITY, YOUNGS, 0.0, (0.0, -speed), 0.3, 1e-4)

    def deck(self, coarse):
        deck = Deck("two bars")
        layers = 25 if coarse else 100
        deck.block(1, (0, 0, 0), (SIDE, SIDE, LENGTH), (2, 2, layers))
        deck.block(2, (0, 0, LENGTH + 0.01), (SIDE, SIDE, 2 * LENGTH + 0.01), (2, 2, layers))
        deck.part(1, "lower bar", 1)
        deck.part(2, "upper bar", 1)
        deck.add("*MAT_ELASTIC", card(1, DENSITY, YOUNGS, 0.0))
        deck.add("*INITIAL_VELOCITY_GENERATION", card(2, 2, 0.0, 0.0, 0.0, -self.speed), "")
        deck.add("*CONTACT_AUTOMATIC_SURFACE_TO_SURFACE", card(1, 2, 3, 3), card(0.0), "")
        deck.add("*CONTROL_TERMINATION", card(0.3), "*DATABASE_GLSTAT", card(1e-4), "*DATABASE_RCFORC", card(1e-4))
        return deck

    def figures(self, results):
        time = results["history/time"][:]
        force = np.abs(results["history/contact/contact_1/normal_force"][:, 2])
        kinetic = results["history/energy/kinetic"][:]
        stored = results["history/energy/internal"][:]
        lasts = 2 * METRES / WAVE
        during = (time > 0.25 * lasts) & (time < 0.75 * lasts)
        begin, end = contact_times(time, force, 0.01)
        given = 0.5 * 7850 * METRES * AREA * self.speed**2
        struck = results["fields/lower_bar/velocity"][-1][:, 2].mean()
        return [
            Figure("contact force", force[during].mean() / 1e3, 7850 * WAVE * AREA * self.speed / 2e3, "kN",
                   "rho c A v / 2"),
            Figure("contact lasts", 1e6 * (end - begin), 1e6 * lasts, "us", "2 L / c"),
            Figure("kinetic energy at the begin", kinetic[0], given, "J", "m v^2 / 2"),
            Figure("elastic energy at most", stored.max(), given / 2, "J", "half of it"),
            Figure("kinetic energy at the end", kinetic[-1], given, "J", "all of it"),
            Figure("velocity of the struck bar", -struck, self.speed, "m/s", "v"),
        ]
