// The summary: how accurate each run was, and its figures side by side.
import { accuracy, many } from "./accuracy.js";
import { numbers } from "./blocks.js";
import { element, table } from "./elements.js";
import { digits, quantity, words } from "./units.js";

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

/** Rows as columns. */
const turned = (rows) => rows[0].map((_, c) => rows.map((row) => row[c]));

/** Fills the section; gives back the figures for the tables: heading and rows. */
export async function summary(place, results) {
    const all = [["", ...results.map(({ name }) => name)], ...(await figures(results))];
    const [heading, ...rows] = many(results) ? turned(all) : all;
    place.replaceChildren(
        accuracy(results),
        element(
            "div",
            { class: `card scroll figures ${many(results) ? "tall" : ""}`, style: "margin-top:1rem" },
            table(heading, rows),
        ),
    );
    return { heading, rows };
}
