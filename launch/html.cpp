#include "launch/html.h"

#include "launch/clean_text.h"

namespace fastball::launch {
namespace {

constexpr const char* kStyle = R"css(
:root { color-scheme: light dark; --ink: #1a1a1a; --soft: #5c5c5c; --line: #d4d4d4; --back: #ffffff; --band: #f4f5f7;
  --link: #00508a; --bad: #a33c00; --badback: #fff3ea; }
@media (prefers-color-scheme: dark) {
  :root { --ink: #e6e6e6; --soft: #a8a8a8; --line: #444a52; --back: #16181b; --band: #20242a; --link: #6db8ef; --bad: #ffb07a;
    --badback: #33231a; }
}
* { box-sizing: border-box; }
body { margin: 0 auto; padding: 1.5rem 1.25rem 4rem; max-width: 68rem; color: var(--ink); background: var(--back);
  font: 1rem/1.5 "DejaVu Sans", system-ui, sans-serif; }
h1 { font-size: 1.6rem; line-height: 1.25; margin: 0 0 .4rem; overflow-wrap: anywhere; }
h2 { font-size: 1.25rem; margin: 2.4rem 0 .6rem; padding-bottom: .2rem; border-bottom: 1px solid var(--line); }
h3 { font-size: 1.05rem; margin: 1.8rem 0 .4rem; }
p { margin: .5rem 0; max-width: 50rem; }
p.lead { font-size: 1.1rem; }
a { color: var(--link); }
nav { font-size: .9rem; margin: 1rem 0; }
nav a { margin-right: .9rem; white-space: nowrap; }
table { border-collapse: collapse; font-size: .85rem; line-height: 1.35; font-variant-numeric: tabular-nums; }
caption { text-align: left; color: var(--soft); padding-bottom: .35rem; }
th, td { padding: .22rem .6rem; text-align: left; vertical-align: top; border-bottom: 1px solid var(--line); }
th { background: var(--band); font-weight: 600; }
thead th { vertical-align: bottom; }
th.n, td.n { text-align: right; }
td.n { white-space: nowrap; }
td code { overflow-wrap: normal; }
td.p, td.p code { overflow-wrap: anywhere; min-width: 6rem; }
.wide { overflow-x: auto; margin: .8rem 0 1.2rem; }
code { font: .92em "DejaVu Sans Mono", ui-monospace, monospace; overflow-wrap: anywhere; }
figure { margin: 1rem 0 1.4rem; }
figure img { display: block; width: 100%; height: auto; background: #fff; border-radius: 4px; }
figcaption { font-size: .85rem; line-height: 1.4; color: var(--soft); margin-top: .35rem; }
.files { white-space: nowrap; }
.missing { border-left: 4px solid var(--bad); background: var(--badback); padding: .5rem 1rem; margin: 1rem 0; }
.missing h2 { border: 0; margin: .2rem 0; font-size: 1.05rem; color: var(--bad); }
.missing ul { margin: .3rem 0; padding-left: 1.2rem; }
@media (prefers-color-scheme: dark) { figure img { filter: brightness(.88); } }
@page { size: A4; margin: 14mm 15mm 15mm; }
@media print {
  :root { color-scheme: light; --ink: #000; --soft: #333; --line: #bbb; --back: #fff; --band: #f0f0f0; --link: #000;
    --bad: #8a2f00; --badback: #fff; }
  body { max-width: none; padding: 0; font-size: 9.5pt; line-height: 1.35; }
  h1 { font-size: 16pt; } h2 { font-size: 13pt; margin-top: 14pt; } h3 { font-size: 11pt; margin-top: 10pt; }
  h1, h2, h3, caption { break-after: avoid; }
  nav, .files { display: none; }
  a { text-decoration: none; }
  p { max-width: none; }
  table { font-size: 8pt; }
  th, td { padding: 1.2pt 4pt; }
  thead { display: table-header-group; }
  tr, figure, .missing { break-inside: avoid; }
  .wide { overflow: visible; margin: 5pt 0 8pt; }
  figure { margin: 3pt 0 5pt; }
  figure img { filter: none; border-radius: 0; max-height: 240mm; object-fit: contain; object-position: left top; }
  figure[id^="release-"] img { max-height: 121mm; } /* a throw on two pages */
  figcaption { font-size: 8pt; line-height: 1.3; margin-top: 2pt; }
  .newpage { break-before: page; }
}
)css";

}  // namespace

Html escaped(const std::string& text) {
  std::string code;
  for (const char c : cleanText(text)) {
    switch (c) {
      case '&':
        code += "&amp;";
        break;
      case '<':
        code += "&lt;";
        break;
      case '>':
        code += "&gt;";
        break;
      case '"':
        code += "&quot;";
        break;
      case '\'':
        code += "&#39;";
        break;
      default:
        code += c;
    }
  }
  return {code};
}

Html addressOf(const std::string& file_name) {
  // "./" so that a colon in the name does not make it another scheme's.
  std::string address = "./";
  for (const char c : file_name) {
    const bool is_plain = (c >= 'a' && c <= 'z') || (c >= 'A' && c <= 'Z') ||
                          (c >= '0' && c <= '9') || c == '-' || c == '_' || c == '.';
    address += is_plain ? std::string(1, c) : fmt::format("%{:02X}", static_cast<unsigned char>(c));
  }
  return {address};
}

Html htmlTable(const std::string& caption,
               const std::vector<HtmlColumn>& columns,
               const std::vector<std::vector<Html>>& rows) {
  Html table{"<div class=\"wide\"><table>\n"};
  if (!caption.empty())
    table += html("<caption>{}</caption>\n", caption);
  table += {"<thead><tr>"};
  for (const HtmlColumn& column : columns)
    table += html("<th scope=\"col\"{}>{}</th>", Html{column.number ? " class=\"n\"" : ""},
                  column.title);
  table += {"</tr></thead>\n<tbody>\n"};
  for (const std::vector<Html>& row : rows) {
    table += {"<tr>"};
    for (std::size_t i = 0; i < row.size(); ++i)
      table += html("<td{}>{}</td>",
                    Html{columns.at(i).prose    ? " class=\"p\""
                         : columns.at(i).number ? " class=\"n\""
                                                : ""},
                    row[i]);
    table += {"</tr>\n"};
  }
  table += {"</tbody></table></div>\n"};
  return table;
}

Html htmlPicture(const std::string& name, const Html& caption, bool with_numbers) {
  Html files = html("<a href=\"{}\">PNG</a> <a href=\"{}\">SVG</a>", addressOf(name + ".png"),
                    addressOf(name + ".svg"));
  if (with_numbers)
    files += html(" <a href=\"{}\">CSV</a>", addressOf(name + ".csv"));
  return html(
      "<figure id=\"{0}\"><img src=\"{1}\" alt=\"{0}\">\n<figcaption>{2} <span "
      "class=\"files\">{3}</span></figcaption></figure>\n",
      name, addressOf(name + ".svg"), caption, files);
}

std::string htmlPage(const std::string& title, const Html& body) {
  return html(
             "<!DOCTYPE html>\n<html lang=\"en\">\n<head>\n<meta charset=\"utf-8\">\n"
             "<meta name=\"viewport\" content=\"width=device-width, initial-scale=1\">\n"
             "<title>{}</title>\n<style>{}</style>\n</head>\n<body>\n{}</body>\n</html>\n",
             title, Html{kStyle}, body)
      .code;
}

}  // namespace fastball::launch
