// The summary: how accurate each run was, and its figures side by side.
import { numbers } from "./blocks.js";
import { element, table } from "./elements.js";
import { digits, quantity, words } from "./units.js";

// Below that share of the largest elastic energy the balance is good (docs/first-steps.md).
const GOOD_BALANCE = 0.01;
// Cells across the minor axis b of a patch: b/20 gives an accurate patch, b/10 is acceptable (thesis 3.1.2).
const ACCURATE_CELLS = 20;
const ACCEPTABLE_CELLS = 10;

const verdict = (level, text) => element("span", { class: `verdict ${level}`, textContent: text });

function endStatement({ completed, reason, time_reached, end_time }) {
    if (completed) return [verdict("good", "Completed"), ` at ${quantity(time_reached ?? end_time, "s", 6)}.`];
    const reached = time_reached === null ? "" : ` at ${quantity(time_reached, "s")} of ${quantity(end_time, "s")}`;
    return [verdict("poor", "Not completed"), `${reached}: ${reason || "the run was killed or goes on"}.`];
}

function energyStatement({ energy }) {
    if (!energy) return ["Energy balance: not written by this run."];
    if (energy.error === null) return ["Energy balance: ", verdict("poor", "broken"), ", its values are not finite."];
    if (!(energy.elastic > 0)) return [`Energy balance: off by ${quantity(energy.error, "J")}; no elastic energy.`];
    const share = energy.error / energy.elastic;
    const good = share < GOOD_BALANCE;
    return [
        "Energy balance: ",
        verdict(good ? "good" : "poor", good ? "kept" : "not kept"),
        `, off by ${digits(100 * share, 2)} % of the largest elastic energy (${quantity(energy.elastic, "J")})`,
        ` at most, at ${quantity(energy.time, "s")}; below 1 % is wanted.`,
    ];
}

function monitorStatement({ warnings }) {
    if (warnings.length === 0) return ["Monitor: ", verdict("good", "no findings"), "."];
    return [
        "Monitor: ",
        verdict("fair", warnings.length === 1 ? "one finding" : `${warnings.length} findings`),
        element(
            "ul",
            {},
            warnings.map((text) => element("li", { textContent: text })),
        ),
    ];
}

function resolutionStatement({ name, resolution }) {
    if (!resolution) return [`Patch of contact ${name}: nothing touched with four nodes or more.`];
    const cells = resolution.minor_axis / resolution.cell;
    const [level, text] =
        cells >= ACCURATE_CELLS
            ? ["good", "fine"]
            : cells >= ACCEPTABLE_CELLS
              ? ["good", "acceptable"]
              : ["poor", "coarse"];
    return [
        `Mesh in the patch of contact ${name}: `,
        verdict(level, text),
        `, cells of ${quantity(resolution.cell, "m", 3)} are b/${digits(cells, 2)} of the minor axis`,
        ` b = ${quantity(resolution.minor_axis, "m", 3)} at ${quantity(resolution.time, "s")}, where the normal force`,
        " is largest. b/10 is acceptable, b/20 accurate (Zhao and Li 2011, in Yang 2018, 3.1.2).",
    ];
}

function settledStatement({ settled_unbalance }) {
    if (settled_unbalance === null) return null;
    return [`Static start: unbalanced forces are ${digits(100 * settled_unbalance, 2)} % of all forces.`];
}

function accuracy(result) {
    const { summary } = result;
    const statements = [
        endStatement(summary),
        energyStatement(summary),
        monitorStatement(summary),
        ...result.contacts.map(resolutionStatement),
        settledStatement(summary),
    ];
    return element(
        "div",
        { class: "card accuracy" },
        element("h3", { textContent: result.name }),
        element("p", { class: "faint", textContent: result.summary.title }),
        element(
            "ul",
            {},
            statements.filter(Boolean).map((parts) => element("li", {}, ...parts)),
        ),
    );
}

const RUN_FIGURES = [
    ["elements", ({ element_count }) => digits(element_count, 8)],
    ["nodes", ({ node_count }) => digits(node_count, 8)],
    ["time reached", ({ time_reached }) => quantity(time_reached, "s", 6)],
    ["steps", ({ steps }) => digits(steps, 12)],
    ["step", ({ step_size }) => (step_size === null ? "–" : `${digits(1e9 * step_size)} ns`)],
    ["wall time", ({ wall_seconds }) => (wall_seconds === null ? "–" : `${digits(wall_seconds, 3)} s`)],
];
// Columns of `railwave contact`, at the last output.
const PATCH_FIGURES = [
    "normal_force",
    "creep_force",
    "lateral_force",
    "traction_coefficient",
    "area",
    "peak_nodal_pressure",
    "peak_shear",
    "semi_axis_along",
    "semi_axis_across",
    "longitudinal_creepage",
    "lateral_creepage",
    "spin_creepage",
];

/** Of each contact the last row of all patches together: {column: {value, unit}}. */
async function lastPatches(contact) {
    const arrays = await Promise.all(contact.patches.map(({ values }) => numbers(values)));
    const of = Object.fromEntries(contact.patches.map(({ name }, i) => [name, arrays[i]]));
    const row = of.patch.lastIndexOf(0);
    return Object.fromEntries(contact.patches.map(({ name, unit }) => [name, { value: of[name][row], unit }]));
}

/** Rows of figures: [what, unit, text of each result]. */
async function figures(results) {
    const rows = RUN_FIGURES.map(([what, of]) => [what, ...results.map(({ summary }) => of(summary))]);
    const names = [...new Set(results.flatMap(({ contacts }) => contacts.map(({ name }) => name)))];
    for (const name of names) {
        const last = await Promise.all(
            results.map(({ contacts }) => {
                const contact = contacts.find((one) => one.name === name);
                return contact ? lastPatches(contact) : null;
            }),
        );
        for (const column of PATCH_FIGURES) {
            const text = (one) => (one ? quantity(one[column].value, one[column].unit) : "–");
            rows.push([`${words(column)}, ${name}, at the end`, ...last.map(text)]);
        }
    }
    return rows;
}

/** Fills the section; gives back the figures for the tables: heading and rows. */
export async function summary(place, results) {
    const rows = await figures(results);
    const heading = ["", ...results.map(({ name }) => name)];
    place.replaceChildren(
        element("div", { class: "cards" }, results.map(accuracy)),
        element("div", { class: "card scroll figures", style: "margin-top:1rem" }, table(heading, rows)),
    );
    return { heading, rows };
}
