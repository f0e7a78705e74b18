// How accurate each run was: its end, its energy balance, the monitor's findings, the mesh in its patches.
import { element, table } from "./elements.js";
import { digits, quantity } from "./units.js";

// Below that share of the largest elastic energy the balance is good (docs/first-steps.md).
const GOOD_BALANCE = 0.01;
// Cells across the minor axis b of a patch: b/20 gives an accurate patch, b/10 is acceptable (thesis 3.1.2).
const ACCURATE_CELLS = 20;
const ACCEPTABLE_CELLS = 10;
// Where it is coarser than that.
const COARSE_ROLLING =
    " Where a body rolls on it, the contact force also swings as nodes come and go, at the velocity over a cell and" +
    " its multiples (docs/contact.md, ripples).";
const MANY = 3; // results: more than these are rows of a table

/** A verdict: what it is on, how good that is, the word for it, and what is said besides, in short and in full. */
const verdict = (what, level, word, short = "", full = "") => ({ what, level, word, short, full });

function onEnd({ completed, reason, time_reached, end_time }) {
    const what = "Run";
    if (completed) return verdict(what, "good", "completed", "", ` at ${quantity(time_reached ?? end_time, "s", 6)}.`);
    const reached = time_reached === null ? "" : ` at ${quantity(time_reached, "s")} of ${quantity(end_time, "s")}`;
    const why = reason || "the run was killed or goes on";
    return verdict(what, "poor", "not completed", reached, `${reached}: ${why}.`);
}

function onEnergy({ energy }) {
    const what = "Energy balance";
    if (!energy) return verdict(what, "fair", "not written");
    if (energy.error === null) return verdict(what, "poor", "broken", "", ", its values are not finite.");
    if (!(energy.held > 0))
        return verdict(what, "fair", "no elastic energy", "", `, off by ${quantity(energy.error, "J")}.`);
    const share = energy.error / energy.held;
    const good = share < GOOD_BALANCE;
    const of = `the largest elastic energy${energy.yields ? " and plastic work" : ""}`;
    return verdict(
        what,
        good ? "good" : "poor",
        good ? "kept" : "not kept",
        `, ${digits(100 * share, 2)} %`,
        `, off by ${digits(100 * share, 2)} % of ${of} (${quantity(energy.held, "J")})` +
            ` at most, at ${quantity(energy.time, "s")}; below 1 % is wanted.`,
    );
}

function onMonitor({ warnings }) {
    const what = "Monitor";
    if (warnings.length === 0) return verdict(what, "good", "no findings", "", ".");
    const word = warnings.length === 1 ? "one finding" : `${warnings.length} findings`;
    const items = warnings.map((text) => element("li", { textContent: text.replace(/^monitor: /, "") }));
    return verdict(what, "fair", word, "", element("ul", {}, items));
}

function onMesh({ name, resolution }) {
    const what = `Mesh in the patch of contact ${name}`;
    if (!resolution) return verdict(what, "fair", "no patch", "", ": nothing touched with four nodes or more.");
    const cells = resolution.minor_axis / resolution.cell;
    const [level, word] =
        cells >= ACCURATE_CELLS
            ? ["good", "fine"]
            : cells >= ACCEPTABLE_CELLS
              ? ["good", "acceptable"]
              : ["poor", "coarse"];
    return verdict(
        what,
        level,
        word,
        `, b/${digits(cells, 2)}`,
        `, cells of ${quantity(resolution.cell, "m", 3)} are b/${digits(cells, 2)} of the minor axis` +
            ` b = ${quantity(resolution.minor_axis, "m", 3)} at ${quantity(resolution.time, "s")}, where the normal` +
            " force is largest. b/10 is acceptable, b/20 accurate (Zhao and Li 2011, in Yang 2018, 3.1.2)." +
            (level === "poor" ? COARSE_ROLLING : ""),
    );
}

function onStart({ settled_unbalance }) {
    if (settled_unbalance === null) return [];
    const share = `${digits(100 * settled_unbalance, 2)} %`;
    return [verdict("Static start", "", "", share, `unbalanced forces are ${share} of all forces.`)];
}

const verdictsOf = ({ summary, contacts }) => [
    onEnd(summary),
    onEnergy(summary),
    onMonitor(summary),
    ...contacts.map(onMesh),
    ...onStart(summary),
];

const word = ({ level, word: text }) => element("span", { class: `verdict ${level}`, textContent: text });

function card(result) {
    const items = verdictsOf(result).map((one) => element("li", {}, `${one.what}: `, word(one), one.full));
    return element(
        "div",
        { class: "card accuracy" },
        element("h3", { textContent: result.name }),
        element("p", { class: "faint", textContent: result.summary.title }),
        element("ul", {}, items),
    );
}

function rowsOf(results) {
    const all = results.map(verdictsOf);
    const heading = [...new Set(all.flatMap((verdicts) => verdicts.map(({ what }) => what)))];
    const cell = (verdicts, what) => {
        const found = verdicts.find((one) => one.what === what);
        return found ? element("span", {}, word(found), found.short) : "–";
    };
    const rows = results.map(({ name }, i) => [name, ...heading.map((what) => cell(all[i], what))]);
    const findings = results.flatMap(({ name, summary }) => summary.warnings.map((text) => `${name}: ${text}`));
    return element(
        "div",
        { class: "card" },
        element("div", { class: "scroll tall accuracy" }, table(["", ...heading], rows)),
        element(
            "details",
            { hidden: findings.length === 0 },
            element("summary", { textContent: `What the monitor found (${findings.length})` }),
            element(
                "ul",
                {},
                findings.map((textContent) => element("li", { textContent })),
            ),
        ),
    );
}

/** A card for each result, or a row where they are many. */
export const accuracy = (results) =>
    results.length > MANY ? rowsOf(results) : element("div", { class: "cards" }, results.map(card));

/** Whether results are rows rather than columns. */
export const many = (results) => results.length > MANY;
