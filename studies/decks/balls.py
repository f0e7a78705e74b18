"""A deck of two balls that meet, and Hertz's theory of impact [Johnson 1985, 11.4]."""

import numpy as np
from comparison import Figure, contact_times
from deck_writer import Deck, card, quarter_ball
from radioss_deck import Model


class Balls:
    """Two equal steel balls of 10 mm radius at 5 m/s, quarters of them behind planes of symmetry. In mm, t, s."""

    name, units = "balls", "mm,t,s"
    source = "two steel balls meet [Johnson 1985, 11.4]"
    radius, youngs, poisson, density, speed = 10.0, 210e3, 0.3, 7.85e-9, 5e3  # mm, MPa, -, t/mm3, mm/s
    radioss = Model(("Mg", "mm", "s"), density, youngs, poisson, (speed / 2, -speed / 2), 6e-5, 5e-8)

    def deck(self, coarse):
        deck = Deck("two balls")
        fine, divisions = (0.05, (7, 10)) if coarse else (0.018, (12, 16))

        def held(i, j, _):
            return 4 if i == 0 and j == 0 else 1 if i == 0 else 2 if j == 0 else 0

        for part, up in ((1, False), (2, True)):
            places = quarter_ball(self.radius, fine, divisions, up)
            if up:
                places[..., 2] += 1e-3
            deck.grid(part, places, held)
            deck.part(part, f"ball {part}", 1, 1)
            velocity = -self.speed / 2 if up else self.speed / 2
            deck.add("*INITIAL_VELOCITY_GENERATION", card(part, 2, 0.0, 0.0, 0.0, velocity), "")
        deck.add("*MAT_ELASTIC", f"{1:10d}{self.density:10.3e}{self.youngs:10.3e}{self.poisson:10.3f}")
        deck.add("*HOURGLASS", card(1, 5, 0.05))
        deck.add("*SET_PART_LIST", card(9), card(1, 2))
        deck.add("*CONTACT_AUTOMATIC_SINGLE_SURFACE", card(9, 0, 2, 0), card(0.0), "")
        deck.add("*CONTROL_TERMINATION", card(6e-5), "*DATABASE_RCFORC", card(5e-8))
        return deck

    def figures(self, results):
        time = results["history/time"][:]
        force = 4 * np.abs(results["history/contact/contact_1/normal_force"][:, 2])
        kinetic = 4 * results["history/energy/kinetic"][:]
        speed, mass = 5.0, 7850 * 4 / 3 * np.pi * 0.01**3  # SI
        stiffness = 4 / 3 * 210e9 / (2 * (1 - 0.3**2)) * np.sqrt(0.005)
        depth = (5 * mass / 2 * speed**2 / (4 * stiffness)) ** 0.4
        given = mass * (speed / 2) ** 2
        begin, end = contact_times(time, force, 1e-4)  # of F ~ sin^1.5: within 0.2 %
        return [
            Figure("largest contact force", force.max() / 1e3, stiffness * depth**1.5 / 1e3, "kN", "Hertz"),
            Figure("contact lasts", 1e6 * (end - begin), 1e6 * 2.9433 * depth / speed, "us", "Hertz"),
            Figure("kinetic energy at the begin", kinetic[0], given, "J", "m v^2 / 4"),
            Figure("kinetic energy at the end", kinetic[-1], given, "J", "all but vibration"),
        ]
