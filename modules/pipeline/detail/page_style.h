#pragma once

#include <string_view>

namespace pneuma {

/// How pages of reports look: colours and letters. What a page has beside that follows it.
constexpr std::string_view PageStyle = R"(
  :root { --ink: #1b2630; --soft: #5d6b78; --line: #d9dfe5; --good: #1f7a4d; --bad: #b3361b; }
  body { font: 14px/1.45 "DejaVu Sans", "Liberation Sans", Arial, sans-serif; color: var(--ink);
         margin: 2em auto; padding: 0 1.5em; }
  header { border-bottom: 2px solid var(--ink); padding-bottom: .7em; }
  .soft { color: var(--soft); }
  .good { color: var(--good); } .bad { color: var(--bad); font-weight: 600; }
  figure { margin: 0; } img { box-sizing: border-box; width: 100%; border: 1px solid var(--line); }
  figcaption { font-size: .85em; color: var(--soft); }
  code { font: .9em "DejaVu Sans Mono", monospace; }
)";

}  // namespace pneuma
