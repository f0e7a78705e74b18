"""Tables and a picture of what scaling_model forecasts, for rank_forecast."""

from scaling_model import BadTable, Model, Network, Partition, Partitions, Run, TERMS, read_table

WEAK, STRONG = (1_000_000, 4_000_000), (4_000_000, 50_000_000)  # elements of a GPU; of all
BAR, JOINT = "bar", "joint"
UNITS = {"fixed": (1e6, "us", "of each step: launches and what waits for them"),
         "per_element": (1e12, "us for a million elements", "elements and their nodes"),
         "several": (1e6, "us", "more on several ranks: two streams, messages, marks"),
         "per_row": (1e9, "us for a thousand rows that a rank sends", "packing, way, unpacking, outer blocks first"),
         "start": (1e3, "ms", "of a run of several ranks, once")}
SUMS_OF_RANK = 3  # messages of a rank at a history: energies of nodes and of blocks, means of one kind of set
BYTES_OF_ELEMENT = 231  # of arrays, all of the model's on each GPU: `railwave check` of the bar of 2 million elements
WORDS = {"elements": "elements", "fixed": "fixed", "several ranks": "of several ranks", "rows": "rows",
         "contact": "rank 0 alone", "network": "network"}


class Forecast:
    def __init__(self, choice):
        self.choice = choice
        self.runs = read_table(choice.runs, Run)
        self.partitions = Partitions(read_table(choice.partitions, Partition))
        self.network = Network(choice.gpus_of_host, choice.bandwidth, choice.latency, choice.neighbour_latency)
        self.bars = [run for run in self.runs if run.scene == BAR]
        self.model = Model.fit(self.bars, self.partitions)
        for run in self.runs:
            if run.scene != BAR:
                self.model.take_contact(run, self.partitions.of(run))

    def left_out(self, run):
        """A run as those without it forecast it, s; None where they cannot."""
        try:
            model = Model.fit([one for one in self.bars if one is not run], self.partitions)
        except BadTable:
            return None
        return model.run_time(run, self.partitions.of(run))

    def step(self, elements, ranks, scene=BAR, contact=None):
        """s of a step by what it is for; None where a scene other than the bar was not dealt out so."""
        if scene != BAR and ranks > 1 and (scene, elements, ranks) not in self.partitions.known:
            return None
        return self.model.step(self.partitions.forecast(scene, elements, ranks), self.network, contact)

    def weak(self, own, ranks):
        """s of a step, and the efficiency. @param own elements of a GPU"""
        alone, now = self.step(own, 1), self.step(own * ranks, ranks)
        return sum(now.values()), sum(alone.values()) / sum(now.values())

    def sums(self, ranks):
        """s of a step that rank 0 takes to get the others' sums at histories, one after the other."""
        return (ranks - 1) * SUMS_OF_RANK * self.choice.message / self.choice.history_steps

    def joint_elements(self):
        return max((run.elements for run in self.runs if run.scene == JOINT), default=0)

    def first(self, breaks):
        """The first number of ranks from 2 on for which breaks(ranks) holds; None up to 4096."""
        return next((ranks for ranks in range(2, 4097) if breaks(ranks)), None)

    def print_all(self):
        for table in (self.terms, self.errors, self.contacts, self.weak_table, self.strong_table, self.breaks):
            print("\n".join(table()) + "\n")

    def terms(self):
        yield from ("| term | fitted | what |", "|---|---|---|")
        for name in TERMS:
            factor, unit, what = UNITS[name]
            yield f"| {name} | {factor * self.model.terms[name]:.3g} {unit} | {what} |"

    def errors(self):
        yield "| scene | GPUs | elements | steps | measured, us a step | model | error | forecast by the other runs |"
        yield "|---|---|---|---|---|---|---|---|"
        for run in self.bars:
            model, left_out = self.model.run_time(run, self.partitions.of(run)), self.left_out(run)
            other = "cannot be" if left_out is None else f"{100 * (left_out / run.step_time - 1):+.1f} %"
            yield (f"| {run.scene} | {run.ranks} | {run.elements} | {run.steps} | {1e6 * run.step_time:.1f} |"
                   f" {1e6 * model:.1f} | {100 * (model / run.step_time - 1):+.2f} % | {other} |")

    def contacts(self):
        yield "| scene | GPUs | us a step | of these rank 0 beyond its elements | share |"
        yield "|---|---|---|---|---|"
        for run in self.runs:
            if run.scene != BAR:
                contact = self.model.contact[run.scene][run.ranks > 1]
                yield (f"| {run.scene} | {run.ranks} | {1e6 * run.step_time:.0f} | {1e6 * contact:.0f} |"
                       f" {100 * contact / run.step_time:.0f} % |")

    def weak_table(self):
        yield "| GPUs |" + "".join(f" {own / 1e6:g} M a GPU: us a step | efficiency |" for own in WEAK)
        yield "|---|" + "---|---|" * len(WEAK)
        for ranks in self.choice.ranks:
            cells = [self.weak(own, ranks) for own in WEAK]
            yield f"| {ranks} |" + "".join(f" {1e6 * time:.0f} | {100 * share:.0f} % |" for time, share in cells)

    def strong_cases(self):
        """(name, elements, scene, contact by whether there are several ranks)"""
        joint = self.model.contact.get(JOINT)
        for elements in STRONG:
            yield f"bar, {elements / 1e6:g} M", elements, BAR, None
        if joint and len(joint) == 2:
            yield f"{max(STRONG) / 1e6:g} M with the joint's contact", max(STRONG), BAR, joint
            yield "joint", self.joint_elements(), JOINT, None

    def strong(self, elements, scene, contact, ranks):
        """Times one GPU, and the parts of a step; None where there is no forecast."""
        alone = self.step(elements, 1, scene, contact and contact[False])
        now = self.step(elements, ranks, scene, contact and contact[True] if ranks > 1 else contact and contact[False])
        return None if now is None else (sum(alone.values()) / sum(now.values()), now)

    def strong_table(self):
        cases = list(self.strong_cases())
        yield "| GPUs |" + "".join(f" {name}: times one | most time |" for name, *_ in cases)
        yield "|---|" + "---|---|" * len(cases)
        for ranks in self.choice.ranks:
            cells = []
            for _, *case in cases:
                found = self.strong(*case, ranks)
                most = found and WORDS[max(found[1], key=found[1].get)]
                cells.append(f" {found[0]:.2f} | {most} |" if found else " | |")
            yield f"| {ranks} |" + "".join(cells)

    def breaks(self):
        """At how many GPUs something takes half."""
        def half(elements, parts, contact=None):
            def holds(ranks):
                step = self.step(elements, ranks, BAR, contact)
                return sum(step[one] for one in parts) >= 0.5 * sum(step.values())
            return self.first(holds)

        yield from ("| what takes half, or all there is | from so many GPUs on |", "|---|---|")
        others = ("fixed", "several ranks", "rows", "network", "contact")
        rows = [(f"all but elements, bar of {elements / 1e6:g} M", half(elements, others)) for elements in STRONG]
        joint = self.model.contact.get(JOINT, {}).get(True)
        if joint is not None:
            elements = self.joint_elements()
            alone = self.step(elements, 1, JOINT)
            at_once = alone["contact"] >= 0.5 * sum(alone.values())
            rows.append((f"rank 0 alone, joint of {elements / 1e6:.2g} M", 1 if at_once else None))
            rows += [(f"rank 0 alone, {own / 1e6:g} M with the joint's contact", half(own, ("contact",), joint))
                     for own in STRONG]
        for own in WEAK:
            rows.append((f"sums of a history every {self.choice.history_steps:g} steps, {own / 1e6:g} M a GPU",
                         self.first(lambda ranks, own=own: self.sums(ranks) >= self.weak(own, ranks)[0])))
            rows.append((f"a GPU's memory, {own / 1e6:g} M a GPU",
                         self.first(lambda ranks, own=own: own * ranks * BYTES_OF_ELEMENT > self.choice.gpu_memory)))
        for what, ranks in rows:
            yield f"| {what} | {'above 4096' if ranks is None else ranks} |"


def draw(forecast, path):
    """Weak and strong scaling, measured and forecast, into a picture."""
    import numpy as np
    from pictures import style

    style.apply()
    import matplotlib.pyplot as plt

    figure, (weak, strong) = plt.subplots(1, 2, figsize=(10, 4.2), layout="constrained")
    ranks = [2 ** k for k in range(11)]
    colours = plt.get_cmap(style.LIST)(np.arange(10))
    for own, colour in zip(WEAK, colours):
        weak.plot(ranks, [100 * forecast.weak(own, n)[1] for n in ranks], color=colour,
                  label=f"{own / 1e6:g} M elements a GPU")
        with_sums = [100 * sum(forecast.step(own, 1).values()) / (forecast.weak(own, n)[0] + forecast.sums(n))
                     for n in ranks]
        weak.plot(ranks, with_sums, color=colour, linestyle=":",
                  label=f"the same, a history every {forecast.choice.history_steps:g} steps")
        weak.plot(*zip(*measured_weak(forecast, own)), "o", color=colour, markersize=5)
    for (name, *case), colour in zip(forecast.strong_cases(), colours):
        found = [(n, forecast.strong(*case, n)) for n in ranks]
        strong.plot(*zip(*[(n, one[0]) for n, one in found if one]), color=colour, label=name)
    for scene, elements, colour in ((BAR, STRONG[0], colours[0]), (JOINT, forecast.joint_elements(), colours[3])):
        points = measured_strong(forecast, scene, elements)
        if points:
            strong.plot(*zip(*points), "o", color=colour, markersize=5)
    strong.plot(ranks, ranks, color="grey", linewidth=0.8, linestyle="--", label="as many times")
    weak.set(xscale="log", ylim=(0, 105), xlabel="GPUs", ylabel="efficiency, %", title="weak scaling")
    strong.set(xscale="log", yscale="log", xlabel="GPUs", ylabel="times one GPU", title="strong scaling")
    for axes in (weak, strong):
        axes.set_xticks(ranks, [str(n) for n in ranks])
        axes.minorticks_off()
        axes.axvspan(forecast.choice.gpus_of_host, ranks[-1], color="grey", alpha=0.1, linewidth=0)
        axes.grid(True)
        axes.legend(frameon=False, fontsize=style.TINY)
    figure.suptitle(
        "Points are measured and hold a run's start, lines are the model. Grey: several hosts, with a network assumed",
        fontsize=style.SMALL,
    )
    figure.savefig(path, dpi=160)
    plt.close(figure)


def measured_weak(forecast, own):
    """(GPUs, efficiency in %) of the bar's runs with about so many elements on each, the longest of each number."""
    found = {}
    for run in forecast.bars:
        if abs(run.elements / run.ranks / own - 1) < 0.01 and run.steps >= getattr(found.get(run.ranks), "steps", 0):
            found[run.ranks] = run
    if 1 not in found:
        return [(1, 100.0)]
    alone = found[1].million_element_steps_per_s
    return [(n, 100 * run.million_element_steps_per_s / n / alone) for n, run in sorted(found.items())]


def measured_strong(forecast, scene, elements):
    found = {run.ranks: run for run in forecast.runs if run.scene == scene and run.elements == elements}
    if 1 not in found:
        return []
    alone = found[1].million_element_steps_per_s
    return [(n, run.million_element_steps_per_s / alone) for n, run in sorted(found.items())]
