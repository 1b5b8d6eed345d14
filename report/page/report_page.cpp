// SPDX-License-Identifier: Apache-2.0
#include "report/page/report_page.h"

#include <array>
#include <stdexcept>
#include <utility>

#include "trajectory/text.h"

#ifdef NOLI_WITH_REPORT
#include <zlib.h>

/// Made by viewer/embed.cmake: HTML with the places @TITLE@, @PAGE@, @CELLS@ and @MOTION@.
extern const char noli_report_page[];
extern const unsigned long noli_report_page_size;
#endif

namespace noli::report {

#ifdef NOLI_WITH_REPORT

namespace {

/// In an element <script>: a text of the data cannot end it.
std::string within_script(const Json& json) {
  const std::string text = json.dump(-1, ' ', false, Json::error_handler_t::replace);
  std::string out;
  for (const char c : text) {
    if (c == '<') {
      out += "\\u003c";
    } else {
      out += c;
    }
  }
  return out;
}

}  // namespace

bool has_report_page() { return true; }

std::string packed(std::string_view bytes) {
  uLongf size = compressBound(bytes.size());
  std::string out(size, '\0');
  const int error = compress2(reinterpret_cast<Bytef*>(out.data()), &size, reinterpret_cast<const Bytef*>(bytes.data()),
                              bytes.size(), Z_BEST_COMPRESSION);
  if (error != Z_OK) throw std::runtime_error("zlib cannot pack the data of the report");
  out.resize(size);
  return base64(out);
}

std::string report_html(const ReportPage& report) {
  const std::array<std::pair<std::string_view, std::string>, 4> parts = {{
      {"@TITLE@", escaped_markup(report.page.at("title").get<std::string>())},
      {"@PAGE@", within_script(report.page)},
      {"@CELLS@", report.cells},
      {"@MOTION@", report.motion},
  }};
  std::string_view rest(noli_report_page, noli_report_page_size);
  std::string out;
  for (const auto& [place, text] : parts) {  // in the order of the page
    const std::size_t at = rest.find(place);
    if (at == std::string_view::npos) throw std::logic_error("the page of reports lacks a place for its data");
    out.append(rest.substr(0, at)).append(text);
    rest.remove_prefix(at + place.size());
  }
  return out.append(rest);
}

#else

bool has_report_page() { return false; }
std::string packed(std::string_view) { throw std::logic_error("built without reports"); }
std::string report_html(const ReportPage&) { throw std::logic_error("built without reports"); }

#endif

}  // namespace noli::report
