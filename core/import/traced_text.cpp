#include "core/import/traced_text.h"

#include <algorithm>

namespace seedmesh {

std::size_t origin_in(const std::vector<TextRun>& runs, std::size_t at) {
  const auto behind = [](std::size_t value, const TextRun& run) { return value < run.at; };
  auto run = std::upper_bound(runs.begin(), runs.end(), at, behind);
  if (run == runs.begin()) return 0;
  --run;
  return run->from + (run->verbatim ? at - run->at : 0);
}

void TracedText::begin_run(TextRun run) {
  if (!runs_.empty()) {
    const TextRun& last = runs_.back();
    const bool goes_on = run.verbatim ? last.verbatim && last.from + (run.at - last.at) == run.from
                                      : !last.verbatim && last.from == run.from;
    if (goes_on) return;
    if (last.at == run.at) runs_.pop_back();
  }
  runs_.push_back(run);
}

void TracedText::copy(std::string_view source, std::size_t from, std::size_t to) {
  if (from >= to) return;
  begin_run({text_.size(), from, true});
  text_ += source.substr(from, to - from);
}

void TracedText::copy(const TracedText& other, std::size_t from, std::size_t to) {
  const auto behind = [](std::size_t value, const TextRun& run) { return value < run.at; };
  auto run = std::upper_bound(other.runs_.begin(), other.runs_.end(), from, behind);
  if (run != other.runs_.begin()) --run;
  for (; from < to && run != other.runs_.end(); ++run) {
    const std::size_t end = run + 1 == other.runs_.end() ? to : std::min(to, (run + 1)->at);
    if (end <= from) continue;
    begin_run({text_.size(), run->from + (run->verbatim ? from - run->at : 0), run->verbatim});
    text_.append(other.text_, from, end - from);
    from = end;
  }
}

TracedText TracedText::part(std::size_t from, std::size_t to) const {
  TracedText out;
  out.copy(*this, from, to);
  return out;
}

void TracedText::write(std::string_view text, std::size_t from) {
  if (text.empty()) return;
  begin_run({text_.size(), from, false});
  text_ += text;
}

std::size_t TracedText::origin(std::size_t at) const { return origin_in(runs_, at); }

}  // namespace seedmesh
