// SPDX-License-Identifier: GPL-3.0-or-later
// The page: every figure with what the report has and what a run gives. It names no time and no
// machine, so that it repeats to the bit.
#include <string>
#include <string_view>

#include "common/output.h"
#include "report/parts.h"

namespace argil::evaluation {
namespace {

constexpr const char* kPageHead = R"(<!DOCTYPE html>
<html lang="en">
<head>
<meta charset="utf-8">
<meta name="viewport" content="width=device-width, initial-scale=1">
<title>Two reports, made again</title>
<style>
body { font: 16px/1.5 "DejaVu Sans", Verdana, sans-serif; color: #222; background: #fff;
       max-width: 1080px; margin: 2em auto; padding: 0 1em; }
h1 { font-size: 1.7em; } h2 { font-size: 1.2em; margin: 2.4em 0 .5em; }
img { width: 100%; border: 1px solid #ddd; }
table { border-collapse: collapse; margin: .8em 0; width: 100%; }
th, td { text-align: left; vertical-align: top; padding: .35em .7em; border-bottom: 1px solid #ddd; }
td.ours { white-space: nowrap; font-weight: bold; }
th { color: #555; font-weight: normal; }
dl { display: grid; grid-template-columns: 8em 1fr; gap: .3em 1em; margin: .6em 0; }
dt { color: #555; } dd { margin: 0; }
code { background: #f3f3f3; padding: .1em .3em; }
nav ol { columns: 2; padding-left: 1.4em; }
</style>
</head>
<body>
<h1>Two reports, made again</h1>
<p>Every figure and every number of two reports that a simulated hand and device can give, from runs
of this program: Blanch, Ferley, Cani and Gascuel, &ldquo;Non-realistic haptic feedback for virtual
sculpture&rdquo; (INRIA research report 5090, 2004), and an unpublished report on the Novint Falcon.
Nothing here needs hardware, and a rerun gives the same bits.</p>
)";

/// Text as HTML.
std::string escaped(std::string_view text) {
  std::string out;
  for (const char c : text) {
    switch (c) {
      case '&':
        out += "&amp;";
        break;
      case '<':
        out += "&lt;";
        break;
      case '>':
        out += "&gt;";
        break;
      case '"':
        out += "&quot;";
        break;
      default:
        out += c;
    }
  }
  return out;
}

/// The name of its picture without the ending, which is the place in the page too.
std::string anchor_of(const ReportFigure& figure) {
  return figure.script.picture.substr(0, figure.script.picture.rfind('.'));
}

std::string valued(const ReportNumber& number) {
  return cli::number(number.ours) +
         (number.unit.empty() ? "" : (number.unit[0] == ' ' ? "" : " ") + number.unit);
}

std::string numbers_table(const ReportFigure& figure) {
  if (figure.numbers.empty()) return {};
  std::string text =
      "<table>\n<tr><th>number</th><th>report</th><th>here</th><th>why they "
      "differ</th></tr>\n";
  for (const ReportNumber& number : figure.numbers) {
    text += "<tr><td>" + escaped(number.name) + "</td><td>" +
            (number.printed.empty() ? "&ndash;" : escaped(number.printed)) +
            "</td><td class=\"ours\">" + escaped(valued(number)) + "</td><td>" +
            escaped(number.why) + "</td></tr>\n";
  }
  return text + "</table>\n";
}

std::string figure_section(const ReportFigure& figure, bool has_pictures) {
  std::string text = "<h2 id=\"" + anchor_of(figure) + "\">" + escaped(figure.title) + "</h2>\n";
  if (has_pictures) {
    text += "<img src=\"" + figure.script.picture + "\" alt=\"" + escaped(figure.title) + "\">\n";
  }
  text += "<dl><dt>The report</dt><dd>" + escaped(figure.printed) + "</dd>\n<dt>Here</dt><dd>" +
          escaped(figure.ours) + "</dd>\n";
  if (!figure.command.empty()) {
    text += "<dt>Alone</dt><dd><code>" + escaped(figure.command) + "</code></dd>\n";
  }
  return text + "</dl>\n" + numbers_table(figure);
}

/// A field of a CSV file.
std::string report_field(const std::string& text) {
  return text.find_first_of(",\"") == std::string::npos ? text : "\"" + text + "\"";
}

}  // namespace

std::string report_page(const ReportFigures& figures, bool has_pictures) {
  std::string text = kPageHead;
  if (!has_pictures) {
    text += "<p>No pictures: install the package gnuplot-nox and run again.</p>\n";
  }
  text += "<nav><ol>\n";
  for (const ReportFigure& figure : figures) {
    text += "<li><a href=\"#" + anchor_of(figure) + "\">" + escaped(figure.title) + "</a></li>\n";
  }
  text += "</ol></nav>\n";
  for (const ReportFigure& figure : figures) text += figure_section(figure, has_pictures);
  return text + "</body>\n</html>\n";
}

std::string report_csv(const ReportFigures& figures) {
  std::string text = "figure,number,unit,printed,ours\n";
  for (const ReportFigure& figure : figures) {
    for (const ReportNumber& number : figure.numbers) {
      text += anchor_of(figure) + "," + report_field(number.name) + "," +
              report_field(number.unit) + "," + report_field(number.printed) + "," +
              cli::number(number.ours) + "\n";
    }
  }
  return text;
}

}  // namespace argil::evaluation
