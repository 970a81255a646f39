#pragma once

namespace firstray::compare {

/// Of the report: light and dark, narrow screens, paper.
inline constexpr const char* report_style = R"(
:root { --ink: #1b1b1f; --paper: #ffffff; --soft: #f1f2f5; --line: #c9ccd3; --note: #55585f; --mark: #fff0d6;
  --accent: #005a9c; color-scheme: light dark; }
@media (prefers-color-scheme: dark) {
  :root { --ink: #e8e8ec; --paper: #15161a; --soft: #22242a; --line: #44474f; --note: #a9acb4; --mark: #4a3714;
    --accent: #7cc0f5; } }
* { box-sizing: border-box; }
body { margin: 0; background: var(--paper); color: var(--ink); font: 16px/1.5 system-ui, "DejaVu Sans", sans-serif; }
main { max-width: 1240px; margin: 0 auto; padding: 16px; }
h1 { font-size: 1.5rem; line-height: 1.25; margin: 0.4em 0; overflow-wrap: anywhere; }
h2 { font-size: 1.2rem; margin: 2em 0 0.5em; border-bottom: 1px solid var(--line); padding-bottom: 0.2em; }
h3 { font-size: 1rem; margin: 1.2em 0 0.4em; }
p, li { max-width: 75ch; overflow-wrap: anywhere; }
.answer { font-size: 1.1rem; background: var(--soft); border-left: 4px solid var(--accent); padding: 0.7em 1em; }
.answer p { margin: 0.3em 0; }
.warning { background: var(--mark); padding: 0.6em 1em; border-left: 4px solid #d55e00; }
.note, figcaption { color: var(--note); font-size: 0.875rem; max-width: 100ch; }
details { margin: 0.6em 0; }
.scroll { overflow-x: auto; max-width: 100%; }
table { border-collapse: collapse; font-size: 0.8125rem; font-variant-numeric: tabular-nums; }
th, td { padding: 0.3em 0.45em; text-align: right; border-bottom: 1px solid var(--line); white-space: nowrap; }
td.text { text-align: left; white-space: normal; }
th { font-weight: 600; vertical-align: bottom; }
th:first-child { text-align: left; position: sticky; left: 0; background: var(--paper); }
tr.marked th, tr.marked td { background: var(--mark); }
.charts { display: grid; grid-template-columns: repeat(auto-fill, minmax(min(100%, 460px), 1fr)); gap: 16px; margin-bottom: 16px; }
figure { margin: 0; break-inside: avoid; }
figure svg { width: 100%; height: auto; }
.triptych { display: grid; grid-template-columns: repeat(3, 1fr); gap: 8px; margin-bottom: 12px; break-inside: avoid; }
.triptych img { width: 100%; height: auto; display: block; border: 1px solid var(--line); }
.triptych .none { border: 1px dashed var(--line); color: var(--note); font-size: 0.875rem; padding: 1em;
  display: grid; place-items: center; text-align: center; min-height: 6em; }
.scale { max-width: 420px; margin: 0.5em 0 1em; font-size: 0.8rem; }
.scale .bar { height: 14px; border: 1px solid var(--line); -webkit-print-color-adjust: exact; print-color-adjust: exact; }
.scale .ends { display: flex; justify-content: space-between; }
code { font-family: ui-monospace, "DejaVu Sans Mono", monospace; font-size: 0.85em; overflow-wrap: anywhere; }
.strip { display: grid; grid-template-columns: repeat(auto-fill, minmax(190px, 1fr)); gap: 8px; }
.strip img { width: 100%; height: auto; display: block; border: 1px solid var(--line); }
@media (max-width: 560px) { main { padding: 10px; } .strip { grid-template-columns: 1fr 1fr; }
  th:first-child { min-width: 6em; max-width: 8.5em; white-space: normal; overflow-wrap: break-word; } .triptych { grid-template-columns: 1fr; }
  .triptych img { max-width: 360px; } }
@page { margin: 12mm; }
@media print { :root { --ink: #000; --paper: #fff; --soft: #f4f4f4; --line: #aaa; --note: #333; --mark: #eee;
    --accent: #333; } body { font-size: 10pt; } main { max-width: none; padding: 0; } .scroll { overflow: visible; }
  table { font-size: 6.5pt; } th, td { padding: 0.2em 0.35em; } th:first-child { position: static; }
  h2, h3, .scale { break-after: avoid; } tr, .scroll, .strip, .scale { break-inside: avoid; }
  .charts { grid-template-columns: 1fr 1fr; } .triptych { max-width: 150mm; }
  .strip { grid-template-columns: repeat(4, 1fr); } }
)";

}  // namespace firstray::compare
