// Bundles the pages' style and a script for each of pages/*.js, and writes them as C++ source:
// node build.mjs WEB_FOLDER OUT.cpp, in the folder with node_modules.
// The style and the fonts end up inside the page, so the bundle has no file beside it.
import { build } from 'esbuild';
import { readdirSync, writeFileSync } from 'node:fs';
import { basename, join } from 'node:path';

// Imports of packages are found from where they were installed: this script's copy there.
const here = process.argv[2];

async function bundle(entry) {
  const result = await build({
    entryPoints: [join(here, entry)],
    absWorkingDir: process.cwd(),
    nodePaths: [join(process.cwd(), 'node_modules')],
    bundle: true,
    minify: true,
    write: false,
    format: 'iife',
    target: ['chrome103', 'firefox113', 'safari16.4'], // the first with DecompressionStream
    charset: 'utf8',
    legalComments: 'inline',
    loader: { '.woff2': 'dataurl' },
    logLevel: 'warning',
  });
  return result.outputFiles[0].text;
}

// Compilers need not take a string literal longer than 64 kB: pieces, which they join.
function literal(text) {
  const bytes = Buffer.from(text, 'utf8');
  const pieces = [];
  for (let at = 0; at < bytes.length; at += 12000) {
    const part = bytes.subarray(at, at + 12000);
    let out = '';
    for (const b of part) {
      if (b === 0x22 || b === 0x5c) out += '\\' + String.fromCharCode(b);
      else if (b === 0x3f || b < 0x20 || b > 0x7e) out += '\\' + b.toString(8).padStart(3, '0');
      else out += String.fromCharCode(b);
    }
    pieces.push(`    "${out}"`);
  }
  return `{\n${pieces.join('\n')},\n    ${bytes.length}}`;
}

const scripts = [];
for (const file of readdirSync(join(here, 'pages')).sort()) {
  // A closing tag inside the bundle would end the element it stands in.
  const script = (await bundle(`pages/${file}`)).replaceAll('</script', '<\\/script');
  scripts.push([basename(file, '.js'), script]);
}
const style = await bundle('style.css');
if (style.includes('</style')) throw new Error('style.css: holds a closing tag');
writeFileSync(process.argv[3], `// Written by analysis/report/web/build.mjs.
#include "analysis/report/web_bundle.hpp"

namespace dipper::analysis::report {

const std::string_view kPageStyle${literal(style)};

const std::vector<PageScript>& page_scripts() {
  static const std::vector<PageScript> all{
${scripts.map(([kind, text]) => `      {"${kind}", ${literal(text)}}`).join(',\n')}};
  return all;
}

}  // namespace dipper::analysis::report
`);
