// What all plots have in common.
import Plotly from "plotly.js-basic-dist-min";

import { named } from "./colours.js";
import { element } from "./elements.js";

const touched = window.matchMedia("(pointer: coarse)");

/** The layout of a plot: axes with titles, colours of the page. Its legend is legend()'s. */
export function layout(x, y, more = {}) {
    const axis = (title) => ({
        title: { text: title, standoff: 8 },
        gridcolor: named("--line"),
        linecolor: named("--line"),
        zerolinecolor: named("--faint"),
        automargin: true,
        exponentformat: "power",
        hoverformat: ".6~g",
    });
    return {
        autosize: true,
        margin: { l: 12, r: 12, t: 32, b: 12 }, // above: the buttons
        paper_bgcolor: "rgba(0,0,0,0)",
        plot_bgcolor: "rgba(0,0,0,0)",
        font: { color: named("--ink"), size: 13, family: "system-ui, sans-serif" },
        showlegend: false,
        modebar: { bgcolor: "rgba(0,0,0,0)", color: named("--faint"), activecolor: named("--accent") },
        hovermode: "x unified",
        hoverlabel: { bgcolor: named("--card"), bordercolor: named("--line"), font: { color: named("--ink") } },
        // On a touch screen a finger scrolls the page; the buttons above the plot zoom.
        dragmode: touched.matches ? false : "zoom",
        ...more,
        xaxis: { ...axis(x), ...more.xaxis },
        yaxis: { ...axis(y), ...more.yaxis },
    };
}

/** Names of the curves of a plot as buttons, which hide a curve or bring it; wraps as text does. */
export function legend(plot, traces) {
    return element(
        "div",
        { class: "legend" },
        traces.map((trace, i) => {
            const button = element(
                "button",
                {
                    type: "button",
                    onclick: async () => {
                        const on = button.getAttribute("aria-pressed") !== "true";
                        button.setAttribute("aria-pressed", on);
                        await Plotly.restyle(plot, { visible: on }, [i]);
                    },
                },
                element("span", {
                    class: `swatch ${trace.line.dash ?? "solid"}`,
                    style: `--colour:${trace.line.color}`,
                }),
                trace.name,
            );
            button.setAttribute("aria-pressed", trace.visible !== false);
            return button;
        }),
    );
}

const settings = {
    responsive: true,
    displaylogo: false,
    modeBarButtonsToRemove: ["select2d", "lasso2d", "autoScale2d"],
};

/** Draws into `place`, or changes what is there. */
export const draw = (place, traces, its) => Plotly.react(place, traces, its, settings);

/** Takes a plot away. */
export const clear = (place) => Plotly.purge(place);

/** Brings the time axis of the plots to the range that the user has chosen in one of them. */
export function linkTimes(plots) {
    let busy = false;
    for (const plot of plots)
        plot.on("plotly_relayout", async (change) => {
            const chosen = change["xaxis.autorange"]
                ? { "xaxis.autorange": true }
                : "xaxis.range[0]" in change
                  ? { "xaxis.range": [change["xaxis.range[0]"], change["xaxis.range[1]"]] }
                  : null;
            if (busy || !chosen) return;
            busy = true;
            await Promise.all(plots.filter((other) => other !== plot).map((other) => Plotly.relayout(other, chosen)));
            busy = false;
        });
}
