"""What a run of a deck is compared by."""

from typing import NamedTuple


class Figure(NamedTuple):
    """One figure of a run beside that of the theory."""

    what: str
    found: float
    theory: float
    unit: str
    by: str  # which formula

    def off(self):
        return self.found / self.theory - 1

    def row(self):
        return (self.what, f"{self.found:.4g} {self.unit}", f"{self.theory:.4g} {self.unit}",
                f"{100 * self.off():+.2f} %", self.by)


def contact_times(time, force, least):
    """First and last time at which the force is above that share of its largest."""
    touching = time[force > least * force.max()]
    return touching[0], touching[-1]
