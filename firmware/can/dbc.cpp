// SPDX-License-Identifier: Apache-2.0
#include "firmware/can/dbc.hpp"

#include "firmware/can/messages.hpp"

namespace striker::can {

namespace {

class Writer {
 public:
  Writer(PutText put, void* context) : put_(put), context_(context) {}

  Writer& operator<<(std::string_view text) {
    put_(context_, text);
    return *this;
  }

  Writer& operator<<(std::int64_t value) { return write_decimal(value, 0); }

  // raw * scale, exactly.
  void write_scaled(std::int64_t raw, const Decimal& scale) {
    std::int64_t digits = raw * scale.digits;
    std::int32_t exponent = scale.exponent;
    while (exponent < 0 && digits % 10 == 0) {
      digits /= 10;
      ++exponent;
    }
    write_decimal(digits, -exponent);
  }

 private:
  Writer& write_decimal(std::int64_t value, int fraction_digits) {
    std::array<char, 32> text{};
    std::size_t begin = text.size();
    std::uint64_t rest = value < 0 ? -static_cast<std::uint64_t>(value) : static_cast<std::uint64_t>(value);
    for (int written = 0; rest != 0 || written <= fraction_digits; ++written) {
      if (written == fraction_digits && written != 0) {
        text[--begin] = '.';
      }
      text[--begin] = static_cast<char>('0' + rest % 10);
      rest /= 10;
    }
    if (value < 0) {
      text[--begin] = '-';
    }
    return *this << std::string_view(&text[begin], text.size() - begin);
  }

  PutText put_;
  void* context_;
};

void write_signal(Writer& out, std::string_view name, int first_bit, int bits, bool is_signed,
                  const Decimal& scale, std::int64_t minimum, std::int64_t maximum, std::string_view unit) {
  out << " SG_ " << name << " : " << first_bit << "|" << bits << (is_signed ? "@1- (" : "@1+ (");
  out.write_scaled(1, scale);
  out << ",0) [";
  out.write_scaled(minimum, scale);
  out << "|";
  out.write_scaled(maximum, scale);
  out << "] \"" << unit << "\" Vector__XXX\n";
}

template <class Message, std::size_t Signals>
void write_message(Writer& out, const Layout<Message, Signals>& message) {
  const MessageInfo& info = message.info;
  out << "BO_ " << info.id << " " << info.name << ": " << info.length << " "
      << node_names[static_cast<std::size_t>(info.sender)] << "\n";
  if (info.data_ids != unprotected) {
    write_signal(out, "crc", 0, 8, false, units::one, 0, 255, "");
    write_signal(out, "counter", 8, 4, false, units::one, 0, 15, "");
  }
  for (const auto& signal : message.signals) {
    write_signal(out, signal.name, signal.first_bit, signal.bits, signal.is_signed, signal.scale,
                 signal.minimum, signal.maximum, signal.unit);
  }
  out << "\n";
}

// A whole-number attribute of a message, and what a message that does not name it has.
struct Attribute {
  std::string_view name;
  std::int64_t absent;
  std::int64_t (*value)(const MessageInfo&);
};

// The first three have the names and meanings of Vector's interaction layer; times in ms.
constexpr std::array<Attribute, 7> attributes = {{
    {"GenMsgCycleTime", 0, [](const MessageInfo& info) { return std::int64_t{info.period_ms}; }},
    {"GenMsgDelayTime", 0, [](const MessageInfo& info) { return std::int64_t{info.traffic.distance_ms}; }},
    {"GenMsgTimeout", 0, [](const MessageInfo& info) { return std::int64_t{info.timeout_ms}; }},
    {"Burst", 1, [](const MessageInfo& info) { return std::int64_t{info.traffic.burst}; }},
    {"Deadline", 0, [](const MessageInfo& info) { return std::int64_t{info.traffic.deadline_ms}; }},
    {"Awaited", 0, [](const MessageInfo& info) { return std::int64_t{info.traffic.awaited ? 1 : 0}; }},
    {"E2EDataIdList", 0, [](const MessageInfo& info) { return std::int64_t{info.data_ids}; }},
}};

void write_attributes(Writer& out, const MessageInfo& info) {
  for (const Attribute& attribute : attributes) {
    const std::int64_t value = attribute.value(info);
    if (value != attribute.absent) {
      out << "BA_ \"" << attribute.name << "\" BO_ " << info.id << " " << value << ";\n";
    }
  }
}

template <class Message, std::size_t Signals>
void write_values(Writer& out, const Layout<Message, Signals>& message) {
  for (const auto& signal : message.signals) {
    if (!signal.values.empty()) {
      out << "VAL_ " << message.info.id << " " << signal.name;
      for (const NamedValue& value : signal.values) {
        out << " " << value.raw << " \"" << value.name << "\"";
      }
      out << " ;\n";
    }
  }
}

}  // namespace

void print_dbc(PutText put, void* context) {
  Writer out(put, context);
  out << "VERSION \"" << protocol_version << "\"\n\nNS_ :\n\nBS_:\n\nBU_:";
  for (const std::string_view node : node_names) {
    out << " " << node;
  }
  out << "\n\n";
  for_each_layout([&](const auto& message) { write_message(out, message); });
  for_each_layout([&](const auto& message) {
    out << "CM_ BO_ " << message.info.id << " \"" << message.info.comment << "\";\n";
  });
  for (const Attribute& attribute : attributes) {
    out << "BA_DEF_ BO_ \"" << attribute.name << "\" INT 0 65535;\n";
  }
  for (const Attribute& attribute : attributes) {
    out << "BA_DEF_DEF_ \"" << attribute.name << "\" " << attribute.absent << ";\n";
  }
  for_each_layout([&](const auto& message) { write_attributes(out, message.info); });
  for_each_layout([&](const auto& message) { write_values(out, message); });
}

}  // namespace striker::can
