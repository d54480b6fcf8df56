// SPDX-License-Identifier: Apache-2.0

#include "pipeline/study/study_plot.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "pipeline/study/readable.h"

namespace lensplane {
namespace {

constexpr double kWidth = 920, kHeight = 560;
constexpr double kLeft = 80, kRight = 200, kTop = 20, kBottom = 60;  // around the axes
constexpr double kLeastPx = 1e-10;

/// Powers of ten along an axis.
struct Axis {
  int least, most;
  double from, to;  // on the page

  double place(double value) const {
    if (!std::isfinite(value)) return to;
    return from + (std::log10(value) - least) / (most - least) * (to - from);
  }
};

Axis axis_over(double least, double most, double from, double to) {
  Axis axis{static_cast<int>(std::floor(std::log10(least))), static_cast<int>(std::ceil(std::log10(most))),
            from, to};
  if (axis.most == axis.least) ++axis.most;
  return axis;
}

/// What stands for a kind of trace: its colour, and a shape of about five pixels round the origin.
struct Kind {
  const char* name;
  const char* style;
  const char* shape;
};
constexpr Kind kKinds[] = {
    {"Kishi", "fill:#8c8c8c", "M0-6L6 0L0 6L-6 0Z"},
    {"Shinotsuka and Makino", "fill:#d1495b", "M0-6L6 5L-6 5Z"},
    {"planes", "fill:#ffffff;stroke:#1c6dd0;stroke-width:2", "M-5 0A5 5 0 1 0 5 0A5 5 0 1 0-5 0Z"},
    {"planes, finite distance", "fill:#1c6dd0", "M-5 0A5 5 0 1 0 5 0A5 5 0 1 0-5 0Z"},
    {"geodesic", "fill:#2a9d6f", "M-5-5H5V5H-5Z"},
};

const Kind& kind_of(const TraceSettings& settings) {
  switch (settings.method) {
    case Method::Kishi:
      return kKinds[0];
    case Method::ShinotsukaMakino:
      return kKinds[1];
    case Method::Planes:
      return kKinds[settings.finite_distance == Choice::Off ? 2 : 3];
    case Method::Geodesic:
      break;
  }
  return kKinds[4];
}

/// Infinite where nothing could be compared: on the upper edge.
double shown_error(const TraceRow& row) {
  return row.error.compared > 0 ? std::max(row.error.p99_px, kLeastPx) : INFINITY;
}

std::string power(int exponent) {
  return fmt::format(R"(10<tspan dy="-6" font-size="10">{}</tspan>)", exponent);
}

std::string grid(const Axis& x, const Axis& y) {
  std::string svg;
  for (int e = x.least; e <= x.most; ++e) {
    const double at = x.place(std::pow(10.0, e));
    svg += fmt::format(
        R"(<path class="grid" d="M{0:.1f} {1}V{2}"/><text x="{0:.1f}" y="{3}" text-anchor="middle">{4}</text>)",
        at, kTop, kHeight - kBottom, kHeight - kBottom + 20, power(e));
  }
  for (int e = y.least; e <= y.most; ++e) {
    const double at = y.place(std::pow(10.0, e));
    svg += fmt::format(
        R"(<path class="grid" d="M{1} {0:.1f}H{2}"/><text x="{3}" y="{4:.1f}" text-anchor="end">{5}</text>)",
        at, kLeft, kWidth - kRight, kLeft - 8, at + 4, power(e));
  }
  const double seen = y.place(kSeenErrorPx);
  if (seen <= kHeight - kBottom && seen >= kTop)
    svg += fmt::format(
        R"(<path class="seen" d="M{1} {0:.1f}H{2}"/><text x="{2}" y="{3:.1f}" dx="-4" text-anchor="end">0.1 px</text>)",
        seen, kLeft, kWidth - kRight, seen - 4);
  svg += fmt::format(R"(<text x="{}" y="{}" text-anchor="middle">seconds a frame</text>)",
                     (kLeft + kWidth - kRight) / 2, kHeight - 16);
  svg += fmt::format(
      R"svg(<text transform="translate(22 {}) rotate(-90)" text-anchor="middle">pixels off, in 99 of 100 pixels</text>)svg",
      (kTop + kHeight - kBottom) / 2);
  return svg;
}

/// Steps through the rows that are worth their time.
std::string front(const Study& study, const Axis& x, const Axis& y) {
  std::vector<const TraceRow*> rows;
  for (const TraceRow& row : study.traces) {
    if (row.pareto) rows.push_back(&row);
  }
  if (rows.empty()) return "";
  std::sort(rows.begin(), rows.end(), [](auto* a, auto* b) { return a->seconds() < b->seconds(); });
  std::string path;
  for (const TraceRow* row : rows) {
    const double px = x.place(row->seconds()), py = y.place(shown_error(*row));
    path += path.empty() ? fmt::format("M{:.1f} {:.1f}", px, py) : fmt::format("H{:.1f}V{:.1f}", px, py);
  }
  return fmt::format(R"(<path class="front" d="{}"/>)", path);
}

std::string point(const TraceRow& row, const Axis& x, const Axis& y) {
  const Kind& kind = kind_of(row.rung.settings);
  const ErrorSummary& e = row.error;
  const std::string off =
      e.compared == 0 ? "nothing to compare"
                      : fmt::format("off by {} (median), {} (99 %), {} at most; {} see something else",
                                    readable_pixels(e.median_px), readable_pixels(e.p99_px),
                                    readable_pixels(e.most_px), readable_share(e.share_validity_differs));
  const std::string title = fmt::format(
      "{}{}: {} a frame; {}{}", name_of(row.rung.settings), row.rung.of_shot ? " (the shot's own)" : "",
      readable_seconds(row.seconds()), off, row.violated ? "; VIOLATES ITS BOUND" : "");
  const std::string ring = row.rung.of_shot ? R"(<circle r="10" class="own"/>)" : "";
  return fmt::format(
      R"svg(<g class="point" transform="translate({:.1f} {:.1f})">{}<path d="{}" style="{}"/><title>{}</title></g>)svg",
      x.place(row.seconds()), y.place(shown_error(row)), ring, kind.shape, kind.style, escaped(title));
}

std::string legend(const Study& study) {
  std::string svg;
  double y = kTop + 12;
  const auto line = [&](const std::string& mark, const std::string& text) {
    svg += fmt::format(R"svg(<g transform="translate({} {})">{}<text x="14" y="4">{}</text></g>)svg",
                       kWidth - kRight + 24, y, mark, text);
    y += 22;
  };
  for (const Kind& kind : kKinds) {
    const bool used = std::any_of(study.traces.begin(), study.traces.end(),
                                  [&](const TraceRow& row) { return &kind_of(row.rung.settings) == &kind; });
    if (used) line(fmt::format(R"(<path d="{}" style="{}"/>)", kind.shape, kind.style), kind.name);
  }
  line(R"(<circle r="8" class="own"/>)", "the shot's own");
  line(R"(<path class="front" d="M-9 0H9"/>)", "nothing is both faster");
  svg += fmt::format(R"(<text x="{}" y="{}">and as right</text>)", kWidth - kRight + 38, y);
  return svg;
}

constexpr const char* kStyle =
    "svg text{font:13px sans-serif;fill:#333} .grid{stroke:#e3e3e3;fill:none} "
    ".seen{stroke:#c9a227;stroke-dasharray:4 3;fill:none} "
    ".front{stroke:#333;stroke-width:1.5;stroke-dasharray:6 3;fill:none} "
    ".own{fill:none;stroke:#e07b00;stroke-width:2.5} "
    ".point:hover path{stroke:#000;stroke-width:2}";

}  // namespace

std::string plot_of(const Study& study) {
  double fastest = INFINITY, slowest = 0, least = kSeenErrorPx, most = kSeenErrorPx;
  for (const TraceRow& row : study.traces) {
    fastest = std::min(fastest, row.seconds());
    slowest = std::max(slowest, row.seconds());
    least = std::min(least, shown_error(row));
    if (std::isfinite(shown_error(row))) most = std::max(most, shown_error(row));
  }
  if (study.traces.empty()) fastest = slowest = 1;
  const Axis x = axis_over(fastest, slowest, kLeft, kWidth - kRight);
  const Axis y = axis_over(least, most, kHeight - kBottom, kTop);
  std::string svg = fmt::format(
      R"(<svg id="plot" xmlns="http://www.w3.org/2000/svg" viewBox="0 0 {} {}" width="{}" role="img"><style>{}</style><rect width="100%" height="100%" fill="#fff"/>)",
      kWidth, kHeight, kWidth, kStyle);
  svg += grid(x, y) + front(study, x, y);
  for (const TraceRow& row : study.traces) svg += point(row, x, y);
  return svg + legend(study) + "</svg>\n";
}

std::string escaped(const std::string& text) {
  std::string result;
  for (const char c : text) {
    if (c == '<')
      result += "&lt;";
    else if (c == '>')
      result += "&gt;";
    else if (c == '&')
      result += "&amp;";
    else if (c == '"')
      result += "&quot;";
    else
      result += c;
  }
  return result;
}

}  // namespace lensplane
