// SPDX-License-Identifier: Apache-2.0
//
// `noli report`: one page of HTML with everything in it; it fetches nothing.
//
// What the page reads (viewer/src/data.js), as JSON:
//   title, made      texts
//   verdict          word, tone: "neutral", "good", "open" or "bad" (report_verdict.h), lines: texts,
//                    caveats: those of the lines that a page never folds
//   facts            pairs of texts; statement: [name, text, shown], shown: to be read without unfolding anything
//   scene            null, or dimension, vertices, cells {faces, edges, points},
//                    parts [{name, first, vertices, fixed, given: only if true, drawn to be seen through}],
//                    frames, times, unit, least, greatest,
//                    steps {begin, list: the ends of the steps}, note
//   contacts         null, or counts by kind, total, initial, per_step [totals], goes_on [steps], settled: no contact
//                    is earlier than the first, first: null or a contact, listed: contacts {step, pair, features, and
//                    if the result has them time, kind, cells, bodies, point}, intersections [{step, cells}]
//   focus            of a run or a repair: null, or the pair that its motion opens with {meets, features, time, words,
//                    name: of the button that leads to it, if no other}
//   plots            [{title, x, y, log, times, series: [{name, values}]}]
//   pictures         [{name, image: a data: address}]; results: [{name, tone, result: any JSON}]
// And, packed (zlib, then base64), cells: vertex numbers, u32, of all faces, edges, points; motion: see PackedFrames.
//
// What this does not do: it computes no verdict. What it shows was computed by others, and the page says by whom.
#pragma once

#include <string>
#include <string_view>

#include "certify/json.h"

namespace noli::report {

struct ReportPage {
  Json page;
  std::string cells, motion;  ///< packed; empty without a scene
};

/// Whether the page without its data, viewer/ as it was bundled, is part of this program (NOLI_WITH_REPORT).
bool has_report_page();

/// zlib, as fast as the smallest result allows, then base64.
std::string packed(std::string_view bytes);

/// The document. Precondition: has_report_page().
std::string report_html(const ReportPage& report);

}  // namespace noli::report
