// What the page was made from, and what it leaves out.
import { element } from "./elements.js";

function ofResult({ name, file, notes, summary }) {
    const since = summary.start_time ? ` from ${summary.start_time} on` : "";
    return element(
        "div",
        {},
        element("h3", { textContent: name }),
        element("p", {
            textContent: `${file}, written by ${summary.program}${since}.`,
        }),
        notes.length > 0
            ? element(
                  "ul",
                  {},
                  notes.map((text) => element("li", { textContent: text })),
              )
            : element("p", { textContent: "Nothing was thinned: all samples and output times are here." }),
        element(
            "details",
            {},
            element("summary", { textContent: `The case: ${summary.case_file}` }),
            element("pre", { textContent: summary.case_text }),
        ),
    );
}

export function about(place, { program, results }) {
    place.replaceChildren(
        element("p", {
            textContent:
                `Made by ${program}. Histories have seven digits. Fields and nodes of patches are stored in 65535` +
                " levels between the smallest and the largest value of each field, component and instant, so that a" +
                " value is off by at most 1/131068 of that range; displacements so beside the rigid motion." +
                " The results files have the full numbers.",
        }),
        ...results.map(ofResult),
    );
}
