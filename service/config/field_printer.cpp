// SPDX-FileCopyrightText: 2026 The graspd authors
// SPDX-License-Identifier: BSD-3-Clause
#include "service/config/field_printer.hpp"

#include <algorithm>
#include <array>
#include <charconv>
#include <cmath>
#include <sstream>

#include "service/config/service_config.hpp"

namespace graspd {
namespace {

constexpr std::size_t kLineWidth = 120;

template <class T>
std::string shortest(T number) {
  std::array<char, 64> text{};
  const auto [end, error] = std::to_chars(text.data(), text.data() + text.size(), number);
  return {text.data(), end};
}

/// Words that mean nothing else in YAML 1.1 or 1.2.
bool is_plain_word(const std::string& text) {
  static const std::array<std::string_view, 9> kOther{"true", "false", "null", "yes", "no",
                                                      "on",   "off",   "y",    "n"};
  const auto allowed = [](char c) {
    return (c >= 'a' && c <= 'z') || (c >= 'A' && c <= 'Z') || (c >= '0' && c <= '9') || c == '_' || c == '/';
  };
  const bool letter_first = !text.empty() && allowed(text[0]) && !(text[0] >= '0' && text[0] <= '9');
  std::string lower = text;
  std::transform(lower.begin(), lower.end(), lower.begin(),
                 [](char c) { return c >= 'A' && c <= 'Z' ? char(c + 32) : c; });
  return letter_first && std::all_of(text.begin(), text.end(), allowed) &&
         std::find(kOther.begin(), kOther.end(), lower) == kOther.end();
}

std::string flow_map(const Gripper& gripper) {
  std::string text;
  for (const PrintedField& field : print_fields(gripper, 0))
    text += (text.empty() ? "" : ", ") + field.key + ": " + field.value;
  return "{" + text + "}";
}

}  // namespace

std::string print_value(bool value) {
  return value ? "true" : "false";
}
std::string print_value(std::int64_t value) {
  return shortest(value);
}
std::string print_value(int value) {
  return shortest(value);
}
std::string print_value(float value) {
  return shortest(value);
}
std::string print_value(double value) {
  return shortest(value);
}

std::string print_value(const std::string& value) {
  if (is_plain_word(value)) return value;
  std::string text = "\"";
  for (const char c : value) {
    if (c == '"' || c == '\\') text += '\\';
    if (static_cast<unsigned char>(c) >= 0x20 && c != 0x7f) {
      text += c;
    } else {
      constexpr std::string_view kHex = "0123456789abcdef";
      text += {'\\', 'x', kHex[static_cast<unsigned char>(c) >> 4], kHex[static_cast<unsigned char>(c) & 15]};
    }
  }
  return text + '"';
}

std::string print_value(const Eigen::Vector3f& value) {
  return print_value(std::vector<float>{value.x(), value.y(), value.z()});
}

std::string print_value(const GripperSetting& value) {
  return value.installed_name.empty() ? flow_map(value.gripper) : print_value(value.installed_name);
}

std::string comment_of(const char* doc, const Range& range) {
  std::ostringstream text;
  text.precision(9);
  text << doc;
  const bool from = std::isfinite(range.min);
  const bool to = std::isfinite(range.max);
  if (from && to) text << " (" << range.min << " to " << range.max << ")";
  if (from && !to) text << " (at least " << range.min << ")";
  if (!from && to) text << " (at most " << range.max << ")";
  return text.str();
}

std::vector<PrintedField> difference(const std::vector<PrintedField>& base,
                                     const std::vector<PrintedField>& changed) {
  std::vector<PrintedField> kept;  // backwards, so that a struct comes after its fields
  for (std::size_t i = changed.size(); i-- > 0;) {
    const bool holds_kept = changed[i].value.empty() && !kept.empty() && kept.back().depth > changed[i].depth;
    if (holds_kept || (!changed[i].value.empty() && changed[i].value != base[i].value))
      kept.push_back(changed[i]);
  }
  std::reverse(kept.begin(), kept.end());
  return kept;
}

std::string to_yaml(const std::vector<PrintedField>& fields, YamlForm form) {
  std::string text;
  for (std::size_t i = 0; i < fields.size(); ++i) {
    const PrintedField& field = fields[i];
    const std::string indent(static_cast<std::size_t>(2 * field.depth), ' ');
    const bool dash = form == YamlForm::kListItem && i == 0;
    const std::string start = dash ? indent.substr(2) + "- " : indent;
    const std::string line = start + field.key + ":" + (field.value.empty() ? "" : " " + field.value);
    if (field.value.empty() && field.depth == 0) text += "\n";
    if (field.comment.empty()) {
      text += line + "\n";
    } else if (line.size() + field.comment.size() + 4 <= kLineWidth) {
      text += line + "  # " + field.comment + "\n";
    } else {
      text += indent + "# " + field.comment + "\n" + line + "\n";
    }
  }
  return text;
}

std::string print(const ServiceConfig& config) {
  std::string text =
      "# SPDX-FileCopyrightText: 2026 The graspd authors\n# SPDX-License-Identifier: BSD-3-Clause\n"
      "# Configuration of graspd; printed by graspd --print-config. Keys that are left out keep their "
      "defaults.\n";
  text += to_yaml(print_fields(config, 0));
  const std::vector<PrintedField> base = print_fields(config.detect, 3);
  for (const SourceConfig& source : config.sources) {
    SourceConfig printed = source;
    printed.sensor.clear();  // its settings are part of what differs from detect: above
    std::vector<PrintedField> fields = print_fields(printed, 2);
    const std::vector<PrintedField> detect = difference(base, print_fields(source.detect, 3));
    fields.erase(
        std::find_if(fields.begin(), fields.end(), [](const auto& f) { return f.key == "detect"; }) + 1,
        fields.end());
    if (detect.empty()) fields.back().value = "{}";
    fields.insert(fields.end(), detect.begin(), detect.end());
    text += to_yaml(fields, YamlForm::kListItem);
  }
  return text;
}

}  // namespace graspd
