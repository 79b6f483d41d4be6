// SPDX-FileCopyrightText: 2026 The graspd authors
// SPDX-License-Identifier: BSD-3-Clause
#include "client/compare/report.hpp"

#include <algorithm>

#include "client/common/text.hpp"

namespace graspd {
namespace {

using Row = std::vector<std::string>;
struct Table {
  Row header;
  std::vector<Row> rows;
};

std::string whole(std::int64_t number) {
  return printed("%lld", static_cast<long long>(number));
}

Table summary_table(const RunComparison& c) {
  return {{"frames", ""},
          {{"answered by both", whole(c.frames)},
           {"with the same handles to the bit", whole(c.same)},
           {"worse", whole(c.worse)},
           {"better", whole(c.better)},
           {"answered before only", whole(c.only_before)},
           {"answered after only", whole(c.only_after)}}};
}

Table status_table(const RunComparison& c) {
  Table table{{"status before", "after", "frames"}, {}};
  for (const auto& [statuses, count] : c.statuses)
    table.rows.push_back({statuses.first, statuses.second, whole(count)});
  return table;
}

Table quantity_table(const RunComparison& c) {
  Table table{{"quantity", "", "values", "mean", "10 %", "median", "90 %", "99 %", "shift"}, {}};
  for (const Quantity& q : c.quantities) {
    for (const auto* run : {&q.before, &q.after}) {
      Row row{q.name, run == &q.before ? "before" : "after", whole(run->count())};
      if (run->count() == 0) {
        row.resize(8, "not measured");
      } else {
        row.push_back(printed("%.3g", run->mean()));
        for (const double share : {0.1, 0.5, 0.9, 0.99}) row.push_back(printed("%.3g", run->quantile(share)));
      }
      row.push_back(run == &q.before ? "" : printed("%.3f", shift_between(q.before, q.after)));
      table.rows.push_back(row);
    }
  }
  return table;
}

Table worst_table(const RunComparison& c) {
  Table table{{"rank", "frame", "channel", "seq", "utime", "net loss", "best score", "handles", "lost",
               "gained", "status"},
              {}};
  for (std::size_t i = 0; i < c.worst.size(); ++i) {
    const FrameDifference& d = c.worst[i].difference;
    table.rows.push_back({whole(static_cast<std::int64_t>(i) + 1), whole(d.frame), plain_line(d.key.channel),
                          whole(d.key.seq), whole(d.key.utime), printed("%.3f", d.net_loss()),
                          printed("%.3f -> %.3f", d.best_before, d.best_after),
                          printed("%d -> %d", d.handles_before, d.handles_after), whole(d.lost),
                          whole(d.gained), d.status_before + " -> " + d.status_after});
  }
  return table;
}

std::string escaped(std::string_view text) {
  std::string result;
  for (const char c : text) {
    switch (c) {
      case '&':
        result += "&amp;";
        break;
      case '<':
        result += "&lt;";
        break;
      case '>':
        result += "&gt;";
        break;
      case '"':
        result += "&quot;";
        break;
      case '|':
        result += "&#124;";
        break;
      default:
        result += c;
    }
  }
  return result;
}

std::string markdown(const Table& table) {
  const auto line = [](const Row& row) {
    std::string text = "|";
    for (const std::string& cell : row) text += ' ' + escaped(cell) + " |";
    return text + '\n';
  };
  std::string text = line(table.header) + "|";
  for (std::size_t i = 0; i < table.header.size(); ++i) text += "---|";
  text += '\n';
  for (const Row& row : table.rows) text += line(row);
  return text + '\n';
}

std::string html(const Table& table) {
  const auto line = [](const Row& row, const char* tag) {
    std::string text = "<tr>";
    for (const std::string& cell : row) text += printed("<%s>", tag) + escaped(cell) + printed("</%s>", tag);
    return text + "</tr>\n";
  };
  std::string text = "<table>\n" + line(table.header, "th");
  for (const Row& row : table.rows) text += line(row, "td");
  return text + "</table>\n";
}

/// Shares of both runs over 40 steps between the smallest and the largest value, as bars beside each other.
std::string html_histogram(const Quantity& q) {
  constexpr int kBars = 40, kHeight = 90, kBar = 12;
  if (q.before.count() == 0 || q.after.count() == 0) return "";
  const auto first = std::min(q.before.bins().begin()->first, q.after.bins().begin()->first);
  const auto last = std::max(q.before.bins().rbegin()->first, q.after.bins().rbegin()->first);
  const auto shares = [&](const Distribution& run) {
    std::vector<double> share(kBars);
    for (const auto& [bin, values] : run.bins())
      share[static_cast<std::size_t>((bin - first) * kBars / (last - first + 1))] +=
          static_cast<double>(values) / static_cast<double>(run.count());
    return share;
  };
  const auto before = shares(q.before), after = shares(q.after);
  const double top = std::max(*std::max_element(before.begin(), before.end()),
                              *std::max_element(after.begin(), after.end()));
  std::string text = printed("<figure><svg width=\"%d\" height=\"%d\">", kBars * kBar, kHeight);
  const auto bar = [&](std::size_t i, double share, int offset, const char* color) {
    const double height = kHeight * share / top;
    text += printed("<rect x=\"%d\" y=\"%.1f\" width=\"5\" height=\"%.1f\" fill=\"%s\"/>",
                    static_cast<int>(i) * kBar + offset, kHeight - height, height, color);
  };
  for (std::size_t i = 0; i < before.size(); ++i) {
    bar(i, before[i], 0, "#0072b2");
    bar(i, after[i], 5, "#d55e00");
  }
  return text +
         printed("</svg><figcaption>%s: %.3g to %.3g; blue before, orange after</figcaption></figure>\n",
                 q.name.c_str(), static_cast<double>(first) * q.before.step(),
                 static_cast<double>(last) * q.before.step());
}

const char* const kRanking =
    "Net loss: what the best score lost, plus half the share of handles without a counterpart after (20 mm, "
    "30 "
    "degrees), less the same the other way round.";
const char* const kShift =
    "Shift: the largest difference between the two distribution functions, 0: alike, 1: apart.";

}  // namespace

std::string markdown_report(const ReportInput& in) {
  const RunComparison& c = in.comparison;
  std::string text = "# Handles, compared\n\nBefore: " + escaped(plain_line(in.before)) +
                     "  \nAfter: " + escaped(plain_line(in.after)) + "\n\n" + markdown(summary_table(c)) +
                     "## Status\n\n" + markdown(status_table(c)) + "## Distributions\n\n" + kShift + "\n\n" +
                     markdown(quantity_table(c)) + "## The frames that got worst\n\n" + kRanking + "\n\n" +
                     markdown(worst_table(c));
  for (const FramePictures& pictures : in.pictures)
    if (!pictures.before.empty())
      text += "![before](" + pictures.before + ") ![after](" + pictures.after + ")\n\n";
  return text;
}

std::string html_report(const ReportInput& in) {
  const RunComparison& c = in.comparison;
  std::string text =
      "<!doctype html>\n<html lang=\"en\"><head><meta charset=\"utf-8\"><title>Handles, compared</title>\n"
      "<style>body{font:15px sans-serif;margin:2em;color:#222}table{border-collapse:collapse;margin:1em 0}"
      "td,th{padding:.25em .7em;border-bottom:1px solid #ddd;text-align:right}td:first-child,th:first-child"
      "{text-align:left}img{max-width:48%}figure{display:inline-block;margin:1em}</style></head><body>\n"
      "<h1>Handles, compared</h1>\n<p>Before: " +
      escaped(plain_line(in.before)) + "<br>After: " + escaped(plain_line(in.after)) + "</p>\n" +
      html(summary_table(c)) + "<h2>Status</h2>\n" + html(status_table(c)) + "<h2>Distributions</h2>\n<p>" +
      kShift + "</p>\n" + html(quantity_table(c));
  for (const Quantity& q : c.quantities) text += html_histogram(q);
  text += "<h2>The frames that got worst</h2>\n<p>" + std::string(kRanking) + "</p>\n" + html(worst_table(c));
  for (const FramePictures& pictures : in.pictures)
    if (!pictures.before.empty())
      text += "<p><img src=\"" + pictures.before + "\" alt=\"before\"> <img src=\"" + pictures.after +
              "\" alt=\"after\"></p>\n";
  return text + "</body></html>\n";
}

}  // namespace graspd
