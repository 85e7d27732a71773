#pragma once

namespace vigil::report {

/// The page's looks, for light and dark, wide and narrow screens, and paper.
inline constexpr const char* kPageStyle = R"css(
:root { color-scheme: light dark; --bg: #f6f7f9; --card: #ffffff; --text: #1b1f27; --soft: #5b6472; --line: #e0e4ea;
  --holds: #0f7a48; --holds-bg: #e2f4ea; --differs: #b3161f; --differs-bg: #fde8e8; --none: #5b6472; --none-bg: #eceff3;
  --accent: #1b5fc1; --warn-bg: #fff4dc; --warn: #7a5200; }
@media (prefers-color-scheme: dark) { :root { --bg: #12151b; --card: #1b2029; --text: #e7eaf0; --soft: #9aa4b5; --line: #2e3542;
  --holds: #63d49b; --holds-bg: #14352a; --differs: #ff8d8d; --differs-bg: #43201f; --none: #a9b2c1; --none-bg: #2a303b;
  --accent: #79aefb; --warn-bg: #3b2f12; --warn: #f2ca6b; } }
* { box-sizing: border-box; }
body { margin: 0; background: var(--bg); color: var(--text); font: 16px/1.55 system-ui, -apple-system, "Segoe UI", Roboto, sans-serif; }
main { max-width: 1280px; margin: 0 auto; padding: 28px 20px 60px; }
header h1 { margin: 0 0 2px; font-size: 1.9rem; letter-spacing: -0.01em; }
header p { margin: 2px 0; color: var(--soft); }
h2 { margin: 0 0 10px; font-size: 1.15rem; }
section { background: var(--card); border: 1px solid var(--line); border-radius: 12px; padding: 20px; margin-top: 18px; }
.tiles { display: grid; gap: 12px; grid-template-columns: repeat(auto-fit, minmax(150px, 1fr)); margin-top: 18px; }
.tile { background: var(--card); border: 1px solid var(--line); border-radius: 12px; padding: 12px 16px; }
.tile b { display: block; font-size: 1.45rem; font-weight: 650; font-variant-numeric: tabular-nums; }
.tile span { color: var(--soft); font-size: 0.86rem; }
.figure { display: grid; gap: 24px; grid-template-columns: minmax(0, 1.75fr) minmax(260px, 1fr); align-items: start; }
.figure svg { display: block; width: 100%; height: auto; color: var(--text); }
@media (prefers-color-scheme: dark) { .figure svg { filter: brightness(1.35); } }
.note { color: var(--soft); font-size: 0.88rem; margin: 8px 0 0; }
.links { font-size: 0.84rem; }
a { color: var(--accent); }
.findings { list-style: none; margin: 0; padding: 0; }
.findings li { border-top: 1px solid var(--line); padding: 12px 0; }
.findings li:first-child { border-top: 0; padding-top: 0; }
.findings p { margin: 4px 0 0; color: var(--soft); font-size: 0.93rem; }
.verdict { display: inline-block; border-radius: 99px; padding: 1px 10px; margin-right: 6px; font-size: 0.78rem; font-weight: 650; }
.holds { color: var(--holds); background: var(--holds-bg); }
.differs { color: var(--differs); background: var(--differs-bg); }
.nottested { color: var(--none); background: var(--none-bg); }
.warning { background: var(--warn-bg); color: var(--warn); border-color: transparent; }
.columns { display: grid; gap: 18px; grid-template-columns: repeat(auto-fit, minmax(min(100%, 420px), 1fr)); align-items: start; }
.scroll { overflow-x: auto; max-width: 100%; }
li, p, h1 { overflow-wrap: anywhere; }
.figure > div, .columns > section { min-width: 0; }
table { border-collapse: collapse; width: 100%; font-size: 0.92rem; font-variant-numeric: tabular-nums; }
th, td { text-align: left; padding: 6px 14px 6px 0; border-bottom: 1px solid var(--line); vertical-align: top; }
th { color: var(--soft); font-weight: 600; }
code { font-size: 0.92em; background: var(--none-bg); border-radius: 5px; padding: 1px 5px; }
footer { color: var(--soft); font-size: 0.85rem; margin-top: 22px; }
@media (max-width: 820px) { .figure { grid-template-columns: minmax(0, 1fr); } main { padding: 18px 12px 40px; }
  section { padding: 14px; } .figure svg { min-width: 620px; } }
@media print { body { background: #fff; } section { break-inside: avoid; } }
)css";

}  // namespace vigil::report
