#pragma once
/// The state of the reader of a cpfg file. Internal header of this directory:
/// cpfg.cpp         lines, keywords and productions
/// cpfg_start.cpp   variables and arrays: `Define`, `Start`, `StartEach`, `EndEach`, `End`
/// cpfg_request.cpp the request
#include <map>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "core/import/cpfg_macros.h"
#include "core/import/cpfg_rules.h"
#include "core/import/cpfg_statements.h"
#include "core/import/cpfg_text.h"
#include "core/import/cpfg_words.h"
#include "core/import/foreign_text.h"
#include "core/lang/expression.h"

namespace seedmesh {

class CpfgReader {
 public:
  CpfgReader(ForeignText& source, std::string clean, const ImportOptions& options)
      : source_(source),
        text_(std::move(clean)),
        options_(options),
        macros_(source),
        words_(source),
        statements_(source, words_),
        between_(source, words_) {}

  Imported read();

 private:
  enum class Part { derivation, decomposition, homomorphism };
  std::string_view text(Line line) const {
    return std::string_view(text_).substr(line.from, line.to - line.from);
  }

  // cpfg.cpp
  TracedText expanded(Line line);
  TracedText expression(Line line);
  bool begins(Line line, std::string_view key, Line& rest) const;
  bool has_block(Line line) const;
  bool keyword(Line line);
  bool block(Line line);
  bool section(Line line, std::string_view key, Part part);
  std::optional<double> number(const TracedText& body, std::size_t at);
  const lang::Names& constants();
  void seed(Line line, double value);
  void depth(Line line, double value);
  void axiom(Line line);
  bool goes_on(Line next) const;
  void production(Line line);

  // cpfg_start.cpp
  void define(const TracedText& block);
  void define_array(const TracedText& block, lsystem::Slice slice);
  TracedText with_one_index(const TracedText& text) const;
  bool put_constants();
  void put_variables();
  void run_start(const TracedText& start);

  // cpfg_request.cpp
  void put(const std::string& name, Json value, std::vector<TextRun> runs);
  void put_rules();
  void put_rule_order();
  void put_surfaces();
  void put_symbols();
  void put_constant(const std::string& name, const TracedText& value);
  Imported made();

  ForeignText& source_;
  std::string text_;
  const ImportOptions& options_;
  CpfgMacros macros_;
  CpfgWords words_;
  CpfgStatements statements_;  ///< converts statements in rules
  CpfgStatements between_;     ///< converts statements of Start, StartEach and EndEach
  std::map<std::string, std::string> constants_;
  std::optional<lang::Names> names_;  ///< the constants, filled at first use
  std::map<std::string, Line> symbols_;
  std::vector<CpfgRule> rules_[3];
  std::map<std::string, std::vector<double>> arrays_;
  /// Dimensions of arrays that have more than one.
  std::map<std::string, std::vector<std::size_t>> dimensions_;
  TracedText start_, start_each_, end_each_;  ///< the blocks without braces, with their macros expanded
  Json parameters_ = Json::object();
  Imported out_;
  Line length_;
  Part part_ = Part::derivation;
  bool begun_ = false, ended_ = false, has_axiom_ = false;
};

}  // namespace seedmesh
