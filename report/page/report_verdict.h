// SPDX-License-Identifier: Apache-2.0
//
// The word at the head of a page: of all that its inputs say, the worst.
//
// What this does not do: it weighs words, and decides nothing. Who said which word is in the lines below it.
#pragma once

#include <string>
#include <string_view>

#include "report/page/report_page.h"

namespace noli::report {

/// Of the words that commands write as their verdict, from the best to the worst. neutral: what was asked has no answer
/// that is good or bad ("measured"). open: nothing was decided, or the word is not known here.
enum class Tone { neutral, good, open, bad };

Tone tone_of(std::string_view word);
std::string_view name(Tone tone);

/// ReportPage::page before anything is known of what it is about.
Json empty_page();

/// Puts the word at the head unless what is there is as bad, or worse: so a page is never greener than any of its
/// inputs. "proved" says more than "no_contact", and takes its place.
void take_word(const std::string& word, ReportPage& report);

/// Adds a line that limits what the verdict says: a page never folds it.
void add_caveat(const std::string& line, ReportPage& report);

/// What a run says of itself that ended so, and whether it goes on still: "no_contact" if it is done, or why it ended,
/// or "undecided".
std::string word_of_end(std::string_view end, bool going_on);

/// "no contact": for sentences.
std::string spoken(std::string word);

}  // namespace noli::report
