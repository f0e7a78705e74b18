// Bundles the page of `railwave report` into one HTML file without data: node build.mjs FOLDER_OF_NODE_MODULES OUT.
// scripts/setup --report calls it.
import { mkdirSync, readFileSync, renameSync, writeFileSync } from "node:fs";
import { createRequire } from "node:module";
import { dirname, join } from "node:path";
import { fileURLToPath } from "node:url";

const here = dirname(fileURLToPath(import.meta.url));
const [modules, out] = process.argv.slice(2);
const { build } = createRequire(join(modules, "here.js"))("esbuild");

const LIBRARIES = ["plotly.js-basic-dist-min", "three"];

function licences() {
    return LIBRARIES.map((name) => {
        const { version, license } = JSON.parse(readFileSync(join(modules, name, "package.json"), "utf8"));
        return `${name} ${version} (${license})\n\n${readFileSync(join(modules, name, "LICENSE"), "utf8").trim()}`;
    }).join("\n\n----------------\n\n");
}

async function bundle(entry) {
    const result = await build({
        entryPoints: [join(here, "src", entry)],
        nodePaths: [modules],
        bundle: true,
        minify: true,
        write: false,
        format: "iife",
        target: ["es2022"],
        charset: "ascii",
        legalComments: "inline",
        logLevel: "warning",
    });
    return result.outputFiles[0].text;
}

const escaped = (text) => text.replaceAll("&", "&amp;").replaceAll("<", "&lt;");
const parts = {
    "/*style*/": await bundle("style.css"),
    "/*script*/": await bundle("main.js"),
    "<!--licences-->": escaped(licences()),
};
let page = readFileSync(join(here, "src", "page.html"), "utf8");
for (const [place, text] of Object.entries(parts)) {
    if (page.split(place).length !== 2) throw new Error(`page.html has no place, or several, for ${place}`);
    page = page.replace(place, () => text);
}
mkdirSync(dirname(out), { recursive: true });
writeFileSync(`${out}.new`, page);
renameSync(`${out}.new`, out);
