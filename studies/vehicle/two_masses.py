"""Two masses on springs and dampers, coupled between Railwave and Simbody, against the exact motion."""

import pathlib

import numpy as np

HERE = pathlib.Path(__file__).resolve().parent
CASE, BOGIE = HERE / "two_masses.toml", HERE / "two_masses_bogie.toml"
BLOCK, DENSITY, YOUNGS_MODULUS = 0.5, 7800, 210e9  # m, kg/m3, Pa: of the case
WHEELSET = DENSITY * BLOCK**3  # kg
FRAME = 3000
STIFFNESS, DAMPING = (4e6, 2e6, 1.2e6), (0, 2301.6, 1188.5)
PLACE, VELOCITY = (1e-3, 0, 1e-3), (0, 0.03, 0.02)  # of the frame, at the start
REDUCED = WHEELSET * FRAME / (WHEELSET + FRAME)  # kg
AXES = "xyz"


class Oscillator:
    """The exact distance of two rigid masses on a spring and a damper, along one axis."""

    def __init__(self, axis):
        self.stiffness, damping = STIFFNESS[axis], DAMPING[axis]
        self.decay = damping / (2 * REDUCED)  # 1/s
        self.angular = np.sqrt(self.stiffness / REDUCED - self.decay**2)
        self.frequency = self.angular / (2 * np.pi)
        self.decrement = 2 * np.pi * self.decay / self.angular
        self.cosine = PLACE[axis]
        self.sine = (VELOCITY[axis] + self.decay * PLACE[axis]) / self.angular

    def distance(self, time):
        phase = self.angular * time
        return np.exp(-self.decay * time) * (self.cosine * np.cos(phase) + self.sine * np.sin(phase))


def elastic_share(axis):
    """By how much less the frequency is for the block's elasticity. The ends of a bar that is pulled in its middle lag:
    its middle is ahead of its centre of mass by F L / (12 E A), and across by that with the shear modulus. A spring of
    that compliance is in series with the suspension. With one element above and one below the middle that is an
    estimate."""
    modulus = YOUNGS_MODULUS / (1 if axis == 2 else 2.6)
    return 0.5 * STIFFNESS[axis] * BLOCK / (12 * modulus * BLOCK**2)


def crossings(time, distance):
    """s, when the distance goes through zero upwards, by straight lines between samples."""
    at = np.flatnonzero((distance[:-1] < 0) & (distance[1:] >= 0))
    return time[at] - distance[at] * (time[at + 1] - time[at]) / (distance[at + 1] - distance[at])


def peaks(time, distance):
    """Maxima, by parabolas through three samples."""
    at = np.flatnonzero((distance[1:-1] > distance[:-2]) & (distance[1:-1] >= distance[2:])) + 1
    values = []
    for k in at:
        values.append(np.polyval(fit := np.polyfit(time[k - 1:k + 2] - time[k], distance[k - 1:k + 2], 2),
                                 -fit[1] / (2 * fit[0])))
    return np.array(values)


class Compared:
    """One axis of a coupled run beside the exact motion."""

    def __init__(self, table, axis):
        self.exact = Oscillator(axis)
        name = AXES[axis]
        self.time = table["time_s"]
        self.distance = table[f"frame_{name}_m"] - table[f"displacement_{name}_m"]
        at = crossings(self.time, self.distance)
        self.frequency = (len(at) - 1) / (at[-1] - at[0])
        high = peaks(self.time, self.distance)
        self.decrement = np.log(high[0] / high[-1]) / (len(high) - 1)
        exact = self.exact.distance(self.time)
        self.difference = np.abs(self.distance - exact).max() / np.abs(exact).max()
