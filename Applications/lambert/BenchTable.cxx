#include "BenchTable.h"

#include <cmath>
#include <cstdio>
#include <cstdlib>
#include <fstream>

#include "Common/Core/Error.h"

namespace lambert {
namespace {

/// A column is a text or a number of the row.
struct Column {
  const char* name;
  std::string BenchRow::*text;
  double BenchRow::*number;

  Column(const char* name_, std::string BenchRow::*t) : name(name_), text(t), number(nullptr) {}
  Column(const char* name_, double BenchRow::*n) : name(name_), text(nullptr), number(n) {}
};

const std::vector<Column>& Columns() {
  static const std::vector<Column> columns{
      {"study", &BenchRow::study},
      {"scene", &BenchRow::scene},
      {"triangles", &BenchRow::triangles},
      {"vertices", &BenchRow::vertices},
      {"triangles_before_tessellation", &BenchRow::coarseTriangles},
      {"method", &BenchRow::method},
      {"knob", &BenchRow::knob},
      {"value", &BenchRow::value},
      {"run", &BenchRow::run},
      {"order", &BenchRow::order},
      {"threads", &BenchRow::threads},
      {"load", &BenchRow::load},
      {"seconds", &BenchRow::seconds},
      {"cpu_s", &BenchRow::cpu},
      {"clustering_s", &BenchRow::clustering},
      {"setup_s", &BenchRow::setup},
      {"bvh_s", &BenchRow::bvh},
      {"solve_s", &BenchRow::iterations},
      {"reconstruction_s", &BenchRow::reconstruction},
      {"output_s", &BenchRow::output},
      {"elements", &BenchRow::elements},
      {"links", &BenchRow::links},
      {"rays", &BenchRow::rays},
      {"peak_mb", &BenchRow::peakMegabytes},
      {"rms", &BenchRow::rms},
      {"rms_low", &BenchRow::rmsLow},
      {"rms_high", &BenchRow::rmsHigh},
      {"bounded", &BenchRow::bounded},
      {"bias", &BenchRow::bias},
      {"percentile_95", &BenchRow::percentile95},
      {"receivers", &BenchRow::receivers},
      {"missed", &BenchRow::missed},
      {"reference_noise", &BenchRow::noise},
      {"stopped_by", &BenchRow::stoppedBy},
      {"note", &BenchRow::note},
  };
  return columns;
}

std::string Quoted(const std::string& text) {
  if (text.find_first_of(",\"\n") == std::string::npos) return text;
  std::string quoted = "\"";
  for (const char c : text) quoted += c == '"' ? "\"\"" : std::string(1, c);
  return quoted + "\"";
}

std::string Field(double number) {
  if (std::isnan(number)) return "";
  char text[32];
  std::snprintf(text, sizeof text, "%.7g", number);
  return text;
}

/// The fields of a line; a quoted one may hold commas and doubled quotes.
std::vector<std::string> Fields(const std::string& line) {
  std::vector<std::string> fields(1);
  bool quoted = false;
  for (size_t i = 0; i < line.size(); ++i) {
    const char c = line[i];
    if (c == '"' && quoted && i + 1 < line.size() && line[i + 1] == '"') {
      fields.back() += line[++i];
    } else if (c == '"') {
      quoted = !quoted;
    } else if (c == ',' && !quoted) {
      fields.emplace_back();
    } else {
      fields.back() += c;
    }
  }
  return fields;
}

const Column* FindColumn(const std::string& name) {
  for (const Column& column : Columns()) {
    if (column.name == name) return &column;
  }
  return nullptr;
}

}  // namespace

void BenchRow::SetError(const SolutionError& error) {
  rms = error.rms, rmsLow = error.rmsLow, rmsHigh = error.rmsHigh;
  bounded = error.bounded, bias = error.bias, percentile95 = error.percentile95;
  receivers = double(error.points), missed = double(error.missedPoints), noise = error.noise;
}

BenchTableWriter::BenchTableWriter(const std::string& fileName) : fileName_(fileName) {
  std::ofstream(fileName_, std::ios::trunc);
  std::string header;
  for (const Column& column : Columns()) {
    header += (header.empty() ? "" : ",") + std::string(column.name);
  }
  Write(header);
}

void BenchTableWriter::Append(const BenchRow& row) {
  std::string line;
  for (const Column& column : Columns()) {
    if (&column != &Columns().front()) line += ',';
    line += column.text ? Quoted(row.*column.text) : Field(row.*column.number);
  }
  Write(line);
}

void BenchTableWriter::Write(const std::string& line) {
  std::ofstream file(fileName_, std::ios::app);
  file << line << '\n';
  if (!file.flush()) throw Error("The table " + fileName_ + " could not be written.");
}

std::vector<BenchRow> ReadBenchTable(const std::string& fileName) {
  std::ifstream file(fileName);
  std::string line;
  if (!std::getline(file, line)) throw Error("The table " + fileName + " could not be read.");
  std::vector<const Column*> columns;
  for (const std::string& name : Fields(line)) columns.push_back(FindColumn(name));

  std::vector<BenchRow> rows;
  for (int64_t number = 2; std::getline(file, line); ++number) {
    const std::vector<std::string> fields = Fields(line);
    const std::string place = fileName + ", line " + std::to_string(number);
    if (fields.size() != columns.size()) {
      throw Error(place + ": there are " + std::to_string(fields.size()) + " fields instead of " +
                  std::to_string(columns.size()) + ".");
    }
    BenchRow row;
    for (size_t i = 0; i < fields.size(); ++i) {
      if (!columns[i] || fields[i].empty()) continue;
      if (columns[i]->text) {
        row.*columns[i]->text = fields[i];
        continue;
      }
      char* end = nullptr;
      row.*columns[i]->number = std::strtod(fields[i].c_str(), &end);
      if (*end) throw Error(place + ": \"" + fields[i] + "\" is not a number.");
    }
    rows.push_back(row);
  }
  return rows;
}

}  // namespace lambert
