#include "report/page_style.h"

namespace sateen {

const char* const page_style = R"css(
:root { color-scheme: light dark; --ground: #f6f5f2; --card: #ffffff; --ink: #1f2226; --quiet: #62676e;
  --line: #dcdad4; --accent: #1a61b5; --good: #17744f; --bad: #b3261e; }
@media (prefers-color-scheme: dark) { :root { --ground: #15171a; --card: #1e2125; --ink: #e6e4df; --quiet: #9aa0a8;
  --line: #363a40; --accent: #7fb2f0; --good: #63c79a; --bad: #f2867e; } }
* { box-sizing: border-box; }
body { margin: 0; background: var(--ground); color: var(--ink);
  font: 16px/1.55 system-ui, -apple-system, "Segoe UI", "DejaVu Sans", sans-serif; }
main { max-width: 964px; margin: 0 auto; padding: 40px 32px 80px; }
h1 { font-size: 30px; line-height: 1.2; margin: 0 0 12px; }
h2 { font-size: 21px; margin: 48px 0 10px; padding-top: 14px; border-top: 1px solid var(--line); }
p { margin: 10px 0; max-width: 76ch; }
.lead { font-size: 18px; color: var(--quiet); }
.note, figcaption { font-size: 14px; color: var(--quiet); }
figure { margin: 22px 0; }
figcaption { margin-top: 8px; max-width: 84ch; }
figure > img { display: block; width: 100%; border-radius: 6px; border: 1px solid var(--line); background: #fff; }
.scroll { overflow-x: auto; margin: 16px 0; }
table { border-collapse: collapse; font-size: 13px; font-variant-numeric: tabular-nums; background: var(--card);
  border: 1px solid var(--line); border-radius: 6px; }
th, td { padding: 5px 9px; text-align: left; border-bottom: 1px solid var(--line); }
th { font-weight: 600; color: var(--quiet); vertical-align: bottom; }
tr:last-child td { border-bottom: 0; }
td.number, th.number { text-align: right; }
td.number { white-space: nowrap; }
td:not(.number) { min-width: 13ch; }
td:empty { min-width: 0; }
td.holds { color: var(--good); font-weight: 700; }
td.fails { color: var(--bad); font-weight: 700; }
.slider { position: relative; margin: 0; overflow: hidden; border-radius: 6px; border: 1px solid var(--line);
  cursor: ew-resize; touch-action: pan-y; user-select: none; max-width: 100%; }
.slider img { display: block; width: 100%; height: auto; pointer-events: none; }
.slider img.over { position: absolute; inset: 0; height: 100%; }
.slider .rule { position: absolute; top: 0; bottom: 0; width: 2px; margin-left: -1px; background: #fff;
  box-shadow: 0 0 4px rgba(0,0,0,.6); pointer-events: none; }
.slider .knob { position: absolute; top: 50%; left: -15px; width: 32px; height: 32px; margin-top: -16px; border-radius: 50%;
  background: #fff; color: #222; font: 700 14px/32px sans-serif; text-align: center; box-shadow: 0 1px 5px rgba(0,0,0,.5); }
.slider .tag { position: absolute; top: 10px; padding: 2px 9px; border-radius: 4px; font-size: 13px; color: #fff;
  background: rgba(0,0,0,.6); pointer-events: none; }
.slider .tag.l { left: 10px; } .slider .tag.r { right: 10px; }
.choices { display: flex; flex-wrap: wrap; gap: 6px 18px; margin: 10px 0 0; font-size: 14px; color: var(--quiet); }
.choices select { font: inherit; color: var(--ink); background: var(--card); border: 1px solid var(--line);
  border-radius: 5px; padding: 3px 8px; margin-left: 6px; }
.choices input { width: 180px; accent-color: var(--accent); vertical-align: middle; }
@media print { .choices { display: none; } h2 { break-after: avoid; } figure { break-inside: avoid; } }
)css";

const char* const page_script = R"js(
for (const figure of document.querySelectorAll('figure.compare')) {
  const stage = figure.querySelector('.slider'), under = stage.querySelector('.under');
  const over = stage.querySelector('.over'), rule = stage.querySelector('.rule');
  const range = figure.querySelector('input'), picks = figure.querySelectorAll('select');
  const tags = stage.querySelectorAll('.tag'), sources = [...figure.querySelector('template').content.querySelectorAll('img')];
  const cut = percent => {
    range.value = percent;
    over.style.clipPath = `inset(0 ${100 - percent}% 0 0)`;
    rule.style.left = percent + '%';
  };
  const pick = () => {
    [over, under].forEach((image, i) => {
      const from = sources[picks[i].selectedIndex];
      image.src = from.getAttribute('src');
      image.alt = tags[i].textContent = from.alt;
    });
  };
  const follow = event => {
    const box = stage.getBoundingClientRect();
    cut(Math.min(100, Math.max(0, 100 * (event.clientX - box.left) / box.width)));
  };
  stage.addEventListener('pointerdown', event => { stage.setPointerCapture(event.pointerId); follow(event); });
  stage.addEventListener('pointermove', event => { if (event.buttons) follow(event); });
  range.addEventListener('input', () => cut(range.value));
  picks.forEach(select => select.addEventListener('change', pick));
  pick();
  cut(50);
}
)js";

}  // namespace sateen
