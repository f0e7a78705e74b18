// Tables to look at and to download, in SI units.
import { numbers } from "./blocks.js";
import { choice, element, save, table } from "./elements.js";
import { digits } from "./units.js";

const cell = (text) => (/[",\n]/.test(text) ? `"${text.replaceAll('"', '""')}"` : text);
const value = (number) => (Number.isFinite(number) ? String(Number(number.toPrecision(7))) : "");

/** CSV of columns {name, unit, values}. */
function csv(columns) {
    const lines = [columns.map(({ name, unit }) => cell(unit ? `${name} [${unit}]` : name)).join(",")];
    for (let row = 0; row < columns[0].values.length; ++row)
        lines.push(columns.map(({ values }) => value(values[row])).join(","));
    return `${lines.join("\n")}\n`;
}

async function historyColumns({ history }) {
    const values = await Promise.all(history.channels.map((one) => numbers(one.values)));
    return [
        { name: "time", unit: "s", values: await numbers(history.time) },
        ...history.channels.map(({ name, unit }, i) => ({ name, unit, values: values[i] })),
    ];
}

async function patchColumns({ patches }) {
    const values = await Promise.all(patches.map((one) => numbers(one.values)));
    return patches.map(({ name, unit }, i) => ({ name, unit, values: values[i] }));
}

const fileName = (...parts) => `${parts.join("-").replaceAll(/[^A-Za-z0-9._=-]+/g, "_")}.csv`;

const thinned = ({ history }) => (history.shown < history.samples ? " (thinned)" : "");

/** All tables of the results: {text, file, columns()}. */
function tablesOf(results) {
    return results.flatMap((result) => [
        ...result.contacts.map((contact) => ({
            text: `${result.name}: patches of contact ${contact.name}`,
            file: fileName(result.name, contact.name, "patches"),
            columns: () => patchColumns(contact),
        })),
        ...(result.history.channels.length > 0
            ? [
                  {
                      text: `${result.name}: histories${thinned(result)}`,
                      file: fileName(result.name, "histories"),
                      columns: () => historyColumns(result),
                  },
              ]
            : []),
    ]);
}

const MOST_ROWS = 200; // that are shown

/** Fills the section. */
export async function tables(place, results, figures) {
    const all = tablesOf(results);
    const shown = element("div", { class: "card scroll tall" });
    const note = element("p", { class: "faint" });
    let chosen = 0;
    const show = async (position) => {
        chosen = Number(position);
        const columns = await all[chosen].columns();
        const count = columns[0].values.length;
        const rows = Array.from({ length: Math.min(count, MOST_ROWS) }, (_, row) =>
            columns.map(({ values }) => digits(values[row], 6)),
        );
        shown.replaceChildren(
            table(
                columns.map(({ name, unit }) => `${name} [${unit}]`),
                rows,
            ),
        );
        const part = count > MOST_ROWS ? `; the first ${MOST_ROWS} are shown` : "";
        note.textContent = `${count} rows, ${columns.length} columns, SI units${part}.`;
    };
    const buttons = element(
        "div",
        { class: "controls" },
        all.length > 0
            ? choice(
                  "Table",
                  all.map(({ text }, i) => [i, text]),
                  0,
                  show,
              )
            : null,
        all.length > 0
            ? element("button", {
                  type: "button",
                  id: "download",
                  textContent: "Download this table (CSV)",
                  onclick: async () => save(all[chosen].file, csv(await all[chosen].columns())),
              })
            : null,
        element("button", {
            type: "button",
            textContent: "Download the summary (CSV)",
            onclick: () =>
                save(
                    "summary.csv",
                    `${[figures.heading, ...figures.rows].map((row) => row.map(cell).join(",")).join("\n")}\n`,
                ),
        }),
    );
    place.replaceChildren(buttons, note, shown);
    if (all.length > 0) await show(0);
    else shown.remove();
}
