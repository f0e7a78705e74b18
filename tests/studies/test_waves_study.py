#!/usr/bin/env python3
"""The study of waves (studies/waves) in its parts: its cases are sound; a made-up Rayleigh wave among noise comes out
with its speed, phase and sense, noise alone as nothing; made-up perturbations and waves from a crack are found where
they are. Its whole is in test_long_waves_study.py."""

import functools
import os
import pathlib
import subprocess
import sys
import tempfile
import types
import unittest

try:
    import h5py
    import numpy as np
except ImportError:
    sys.exit(77)

ROOT = pathlib.Path(os.environ["RAILWAVE_SOURCE_DIR"])
STUDY = ROOT / "studies" / "waves"
PROGRAM = pathlib.Path(os.environ["RAILWAVE_BIN_DIR"]) / "railwave"
sys.path[:0] = [str(folder) for folder in (STUDY, STUDY.parent / "common", STUDY.parent / "squeal", ROOT / "scripts")]
import cases  # noqa: E402
import crack  # noqa: E402
import particles  # noqa: E402
import perturbation  # noqa: E402
import reduced  # noqa: E402
import running_surface  # noqa: E402
import scenes  # noqa: E402
import spectrum  # noqa: E402

SPEED = 2700.0  # m/s, of the made-up wave: none that the study would find by itself
X, Y = np.arange(0.130, 0.1741, 1e-3), np.arange(0.740, 0.7701, 1e-3)
PLACE = np.array([(x, y, 0.16 - (y - 0.755) ** 2 / 0.6) for x in X for y in Y])
FROM = np.array([0.152, 0.754])
TIME = 5.6e-3 + 0.25e-6 * np.arange(520)


@functools.cache
def noise(seed):
    return np.random.default_rng(seed).normal(size=(len(TIME), len(PLACE), 3)).astype(np.float32)


@functools.cache
def wave(sense):
    """Velocity of a Rayleigh wave from 0.3 to 0.6 MHz that goes out from a place; sense: 1: retrograde."""
    random = np.random.default_rng(5)
    frequency = np.fft.rfftfreq(1024, TIME[1] - TIME[0])
    strength = (random.normal(size=len(frequency)) + 1j * random.normal(size=len(frequency)))
    strength *= (frequency > 0.3e6) & (frequency < 0.6e6)
    way = PLACE[:, :2] - FROM
    away = np.hypot(*way.T)
    phase = strength[:, None] * np.exp(-2j * np.pi * frequency[:, None] * away / SPEED)
    phase /= np.sqrt(np.maximum(away, 1e-3))
    normal, radial = (np.fft.irfft(part, axis=0)[:len(TIME)]
                      for part in (phase * spectrum.normal_over_tangential(), 1j * sense * phase))
    outwards = way / np.maximum(away, 1e-9)[:, None]
    velocity = np.concatenate([radial[..., None] * outwards, normal[..., None]], axis=2)
    return (velocity / velocity.std()).astype(np.float32)


def ridge_of(velocity):
    field = spectrum.Field(TIME, PLACE, velocity)
    return field, spectrum.Ridge(spectrum.Spectrum(field))


class RayleighWave(unittest.TestCase):
    def test_theory(self):
        self.assertAlmostEqual(spectrum.rayleigh_speed(), 2984.3, delta=0.1)
        self.assertAlmostEqual(spectrum.normal_over_tangential(), 1.524, delta=1e-3)

    def test_speed_and_motion_of_a_wave_in_noise(self):
        field, ridge = ridge_of(wave(1) + 2 * noise(1))
        uncorrected = ridge.fitted(np.flatnonzero((ridge.frequency > 0.35e6) & (ridge.frequency < 0.55e6)))[0]
        ridge.calibrate(field, [(FROM[0], FROM[1] - Y[0])])
        clear = ridge.clear(ridge.limit(field))
        frequency = ridge.frequency[clear]
        self.assertGreater(len(clear), 6)
        self.assertGreater(frequency.min(), 0.28e6)
        self.assertLess(frequency.max(), 0.62e6)
        speed, error = ridge.fitted(clear)
        self.assertLess(abs(speed / SPEED - 1), 0.02, f"{speed} +- {error}, uncorrected {uncorrected}")
        phase, coherence, ratio = ridge.motion(clear)
        self.assertAlmostEqual(phase, -90, delta=15)
        self.assertGreater(coherence, 0.8)
        self.assertAlmostEqual(ratio, 1.52, delta=0.15)

    def test_a_wave_that_turns_the_other_way(self):
        _, ridge = ridge_of(wave(-1) + noise(1))
        chosen = np.flatnonzero((ridge.frequency > 0.35e6) & (ridge.frequency < 0.55e6))
        self.assertAlmostEqual(ridge.motion(chosen)[0], 90, delta=15)

    def test_noise_is_no_wave(self):
        field, ridge = ridge_of(noise(2))
        self.assertLessEqual(len(ridge.clear(ridge.limit(field))), 1)
        self.assertLess(ridge.motion(np.arange(len(ridge.frequency)))[1], 0.1)

    def test_heading(self):
        """A plane wave goes where it goes to, not where it comes from."""
        way = np.array([np.cos(2.0), np.sin(2.0)])
        phase = 2 * np.pi * 0.4e6 * (TIME[:, None] - (PLACE[:, :2] @ way)[None] / SPEED)
        velocity = np.zeros((len(TIME), len(PLACE), 3), np.float32)
        velocity[..., 2] = np.cos(phase)
        _, ridge = ridge_of(velocity)
        angles, power = ridge.heading([int(np.abs(ridge.frequency - 0.4e6).argmin())])
        self.assertAlmostEqual(angles[power.argmax()], np.degrees(2.0), delta=15)

    def test_particle(self):
        time = 18.18e-3 + 0.25e-6 * np.arange(360)
        angle = 2 * np.pi * 0.495e6 * time
        random = np.random.default_rng(3).normal(size=(2, len(time)))
        velocity = np.column_stack([0 * time, np.cos(angle + 0.5 * np.pi) + 30 * (time - time[0]) / 9e-5,
                                    1.5 * np.cos(angle)])
        velocity[:, 1:] += 0.3 * random.T
        one = particles.Particle(time, velocity, (0, 1))
        phase, coherence, chance = one.relation((0.48e6, 0.51e6))
        self.assertAlmostEqual(phase, -90, delta=10)
        self.assertGreater(coherence, 0.8)
        self.assertLess(chance, 0.6)
        ratio, phase, polarised = one.ellipse((0.46e6, 0.53e6))
        self.assertAlmostEqual(ratio, 1.5, delta=0.15)
        self.assertAlmostEqual(phase, -90, delta=10)
        self.assertGreater(polarised, 0.9)
        self.assertAlmostEqual(one.dominant("normal"), 0.495e6, delta=1.2e4)
        turned = particles.Particle(time, velocity, (0, -1))
        self.assertAlmostEqual(turned.relation((0.48e6, 0.51e6))[0], 90, delta=10)


def rolled(events, at):
    """A patch of 14 by 10 mm in cells of 1 mm that rolls at 27.78 m/s and slips the more the farther behind its border;
    at the times of `events` nodes near a place `at` (in half lengths) slip for 4 us."""
    random = np.random.default_rng(7)
    time = 16.5e-3 + 1e-6 * np.arange(1600)
    rows, node, place, normal, tangential, slip = [], [], [], [], [], []
    for t in time:
        middle = 27.78 * (t - time[0])
        column = np.arange(np.ceil((middle - 0.007) / 1e-3), np.floor((middle + 0.007) / 1e-3) + 1)
        x, y = (values.ravel() for values in np.meshgrid(1e-3 * column - middle, 1e-3 * np.arange(-5, 6),
                                                         indexing="ij"))
        inside = (x / 0.007) ** 2 + (y / 0.005) ** 2 < 1
        x, y = x[inside], y[inside]
        force = np.sqrt(1 - (x / 0.007) ** 2 - (y / 0.005) ** 2)
        speed = 0.01 * random.normal(size=(len(x), 2))
        speed[:, 0] += 60 * np.maximum(-0.002 - x, 0)
        if any(0 <= t - event < 4e-6 for event in events):
            speed[np.hypot(x - 0.007 * at[0], y - 0.005 * at[1]) < 1.1e-3] += (0.5, 0)
        number = np.round((x + middle) / 1e-3) * 11 + np.round(y / 1e-3) + 5 + 1000
        order = np.argsort(number)
        rows.append(len(order))
        node.append(number[order])
        place.append(np.column_stack([x + middle, y])[order])
        normal.append(force[order])
        share = np.where(x < -0.002, 1.0, 0.6)
        tangential.append((0.45 * share * force)[order, None] * (1, 0))
        slip.append(speed[order])
    made = reduced.Rolled.__new__(reduced.Rolled)
    made.name, made.earlier, made.friction = "made", 0.0, 0.45
    made._kept = {
        "contact_time": time, "contact_origin": np.zeros((len(time), 2)), "contact_rows": np.cumsum(rows),
        "contact_node": np.concatenate(node).astype(int),
        "contact_place": np.concatenate(place), "contact_normal": np.concatenate(normal),
        "contact_tangential": np.concatenate(tangential), "contact_slip": np.concatenate(slip)}
    made.time, made.normal = time, np.full(len(time), 110.0)
    made.longitudinal, made.lateral = np.full(len(time), 35.0), np.zeros(len(time))
    return made


class Perturbations(unittest.TestCase):
    EVENTS = 16.6e-3 + 0.3e-3 * np.arange(5)

    def test_at_the_leading_edge(self):
        one = perturbation.Disturbed(rolled(self.EVENTS, (0.85, 0)))
        events = one.events()
        self.assertEqual(len(events), len(self.EVENTS))
        self.assertLess(np.abs(one.time[events] - self.EVENTS).max(), 4e-6)
        counts, share = one.where(events)
        self.assertEqual(list(counts), [5, 0, 0])
        self.assertLess(share[0], 0.5)
        self.assertAlmostEqual(one.period()[0], 0.3e-3, delta=0.3e-4)
        self.assertGreater(one.by_place()[0], 1.3)

    def test_at_the_border_of_slip(self):
        one = perturbation.Disturbed(rolled(self.EVENTS, (-0.25, 0)))
        counts, _ = one.where(one.events())
        self.assertGreaterEqual(counts[1], 4)
        self.assertEqual(counts[0], 0)

    def test_noise_alone(self):
        one = perturbation.Disturbed(rolled([], (0, 0)))
        self.assertEqual(len(one.events()), 0)
        self.assertAlmostEqual(one.deviation(one.held), 0.01 * np.sqrt(2), delta=0.002)
        rows, pictures = perturbation.study({"traction": rolled([], (0, 0)), "braking": rolled(self.EVENTS, (0.85, 0))})
        self.assertIn("0; ", next(found for what, _, found, *_ in rows if what.startswith("traction: perturbations")))
        self.assertEqual(len(pictures), 3)


class Crack(unittest.TestCase):
    def test_waves_that_leave_the_mouth(self):
        """The same noise in both rails; from one mouth a wave of 2.98 km/s while the patch is near it."""
        x, y = np.arange(0.115, 0.1851, 1e-3), np.arange(0.740, 0.7651, 1e-3)
        place = np.array([(a, b, 0.16) for a in x for b in y])
        corner = [a * len(y) + b for a in range(len(x) - 1) for b in range(len(y) - 1)]
        facets = np.array([(k, k + len(y), k + len(y) + 1, k + 1) for k in corner])
        mouth = 0.150
        time = 17.2e-3 + 1e-6 * np.arange(1200)
        own = np.random.default_rng(4).normal(size=(len(time), len(place))) * 0.02
        away = np.abs(place[:, 0] - mouth)
        late = time[:, None] - away / 2980.0
        random = np.random.default_rng(6).normal(size=2000)
        sent = np.interp(late, 17.1e-3 + 2e-6 * np.arange(2000), random) * np.interp(time, (17.5e-3, 18e-3),
                                                                                    (0, 0.1))[:, None]
        both = []
        for cracked in (False, True):
            velocity = np.zeros((len(time), len(place), 3), np.float32)
            velocity[..., 2] = own + cracked * sent
            at, corners = place, facets
            if cracked:
                line = np.flatnonzero((np.abs(place[:, 0] - mouth) < 1e-6) & (np.abs(place[:, 1] - 0.7525) < 0.01))
                at = np.concatenate([place, place[line]])
                velocity = np.concatenate([velocity, velocity[:, line]], axis=1)
            one = types.SimpleNamespace(surface=running_surface.RunningSurface.of(time, at, corners, velocity))
            one.patch_at = lambda t: np.array([0.130 + 27.78 * (t - 17.2e-3), 0.7525, 0.007, 0.005, 0, 0])
            both.append(one)
        crossing = crack.Crossing(*both)
        self.assertAlmostEqual(crossing.middle[0], mouth, delta=1e-6)
        self.assertAlmostEqual(crossing.half, 0.0095, delta=6e-4)
        phase = crossing.when(crossing.time, crossing.patch)
        strength = [crossing.deviation(crossing.wave, phase == k) for k in range(3)]
        self.assertLess(strength[0], 0.2 * strength[1])
        self.assertLess(strength[1], strength[2])
        (speed, out), (_, inwards) = crossing.moving(phase == 1)
        self.assertAlmostEqual(speed, 2980, delta=450)  # over 22 mm and with samples each microsecond
        self.assertGreater(out, 0.8)
        self.assertLess(inwards, 0.6)
        for figure in (crack.draw_maps(crossing), crack.draw_ways(crossing)):
            crack.plt.close(figure)


class Cases(unittest.TestCase):
    def test_each_scene_is_sound(self):
        with tempfile.TemporaryDirectory(prefix="railwave-") as folder:
            for name, scene in scenes.SCENES.items():
                case = pathlib.Path(folder) / f"{name}.toml"
                case.write_text(scenes.text(scene), encoding="utf-8")
                words = [PROGRAM, "check", case]
                for override in scenes.settings(scene, "coarse", ["seams.crack.angle=0.3"]):
                    words += ["--set", override]
                done = subprocess.run(words, capture_output=True, text=True)
                self.assertEqual(done.returncode, 0, done.stderr)
                self.assertEqual("[seams.crack]" in done.stdout + done.stderr, scene.crack)
                self.assertIn("(waves)", done.stdout)

    def test_what_is_kept_of_a_run(self):
        with tempfile.TemporaryDirectory(prefix="railwave-") as folder:
            results, path = (pathlib.Path(folder) / name for name in ("r.h5", "r.npz"))
            place = np.array([(x, y, 0.0) for x in range(4) for y in range(3)]) * 1e-3
            corner = [3 * a + b for a in range(3) for b in (0, 1)]
            facets = np.array([(k, k + 3, k + 4, k + 1) for k in corner])
            time = np.array([0, 1e-3, 1.001e-3, 1.002e-3, 5e-3])
            velocity = np.random.default_rng(0).normal(size=(5, 12, 3))
            with h5py.File(results, "w") as file:
                group = file.create_group("fields/track_rail.waves")
                group["time"], group["coordinates"], group["connectivity"] = time, place, facets
                group["velocity"] = velocity
                side = file.create_group("contact/tread/slave")
                file["contact/tread"].attrs["friction"] = 0.45
                file["contact/tread/time"], side["rows"] = [1e-3, 1.001e-3], [2, 4]
                side["coordinates"], side["near/node"] = place, [0, 1, 1, 2]
                side["near/displacement"] = np.zeros((4, 3))
                side["near/normal_force"] = [[0, 0, 5], [0, 0, 0], [0, 0, 6], [0, 0, 7]]
                side["near/tangential_force"], side["near/slip_velocity"] = np.ones((4, 3)), np.ones((4, 3))
                for force in ("normal_force", "tangential_force"):
                    file[f"history/contact/tread/{force}"] = np.ones((5, 3))
                file["history/contact/tread/nodes_in_contact"] = np.ones(5)
                for name in ("time", "energy/balance_error", "energy/internal"):
                    file[f"history/{name}"] = time
            reduced.write(path, results, tangential=True)
            one = reduced.Rolled("made", path, cases.EARLIER)
            self.assertEqual([len(nodes) for _, nodes, *_ in one.contacts()], [1, 2])
            self.assertLess(np.abs(list(one.contacts())[1][2] - place[[1, 2], :2]).max(), 1e-6)
            self.assertEqual(len(one.surface.time), 3)
            self.assertAlmostEqual(one.surface.time[0], 1e-3 + cases.EARLIER)
            back = one.surface.velocity + one["swaying"][:, None]
            self.assertLess(np.abs(back - velocity[1:4]).max(), 5e-3)


if __name__ == "__main__":
    unittest.main()
