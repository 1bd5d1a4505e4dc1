// SPDX-License-Identifier: Apache-2.0
// What a DBC file says of its messages and their traffic: the statements of the format, each read whole to its end.
//
// Read for what they say: BO_, BU_ and the attributes of messages that bear on traffic (BA_DEF_ BO_, BA_DEF_DEF_,
// BA_ ... BO_). Read for their end alone: VERSION, NS_, BS_, SG_, BO_TX_BU_, CM_, the other attributes (of nodes,
// signals, environment variables, relations and signal types), VAL_, VAL_TABLE_, SIG_GROUP_, SIG_VALTYPE_,
// SG_MUL_VAL_, EV_, EV_DATA_, ENVVAR_DATA_, SGTYPE_, SGTYPE_VAL_, SIG_TYPE_REF_, SIGTYPE_VALTYPE_, CAT_DEF_, CAT_ and
// FILTER. Nothing else is skipped: it is an error. Statements may come in any order, several in a line, over any
// number of lines.
//
// The statements are those of the keyword list that every DBC file carries under NS_, in the forms that cantools,
// canmatrix and the public grammars of the format agree on.
#pragma once

#include <array>
#include <cstdint>
#include <functional>
#include <map>
#include <set>
#include <string>
#include <string_view>
#include <vector>

namespace striker::sil {

// Of messages. Times in ms.
namespace dbc_attribute {
inline constexpr std::string_view cycle_time = "GenMsgCycleTime";
inline constexpr std::string_view delay_time = "GenMsgDelayTime";  // shortest distance
inline constexpr std::string_view send_type = "GenMsgSendType";   // "Cyclic", "OnEvent", "NoMsgSendType", ...
inline constexpr std::string_view frame_format = "VFrameFormat";  // "StandardCAN", "ExtendedCAN_FD", ...
inline constexpr std::string_view bit_rate_switch = "CANFD_BRS";  // 0: the frame keeps the bus's bit rate
inline constexpr std::string_view burst = "Burst";                // these three are Striker's own
inline constexpr std::string_view deadline = "Deadline";
inline constexpr std::string_view awaited = "Awaited";  // not 0: a frame of lockstep, in no budget

inline constexpr std::array<std::string_view, 8> all = {cycle_time,      delay_time, send_type, frame_format,
                                                        bit_rate_switch, burst,      deadline,  awaited};
}  // namespace dbc_attribute

inline constexpr std::uint32_t extended_identifier_bit = 0x80000000;

struct DbcValue {
  std::string text;
  bool is_text = false;  // in quotes
  int line = 0;
};

struct DbcMessage {
  std::string name;    // as in the file, in whatever encoding that is
  std::string sender;  // likewise
  std::int64_t bytes = 0;
  int line = 0;
};

struct DbcDefinition {
  enum class Type { whole, hex, real, text, choice };  // INT, HEX, FLOAT, STRING, ENUM
  Type type = Type::whole;
  std::vector<std::string> choices;
};

// `values`, `definitions` and `defaults` hold what dbc_attribute::all names, `definitions` what messages have.
struct DbcFile {
  using Values = std::map<std::string, DbcValue, std::less<>>;

  std::string name;                              // for errors
  std::map<std::uint32_t, DbcMessage> messages;  // by identifier, extended_identifier_bit included
  std::map<std::uint32_t, Values> values;        // of messages, by identifier: there may be no such message
  std::map<std::string, DbcDefinition, std::less<>> definitions;
  Values defaults;
  std::set<std::string, std::less<>> defined_elsewhere;  // attributes of signals, nodes, the file, ...
};

inline constexpr std::size_t most_dbc_messages = 10'000;

// `name` is for errors. Throws std::runtime_error with one line that names the file, the line, what is wrong there,
// and the way out: no statement, no end of one, a number out of range, an identifier or a value that is given twice,
// more than `most_dbc_messages`, none.
[[nodiscard]] DbcFile parse_dbc(std::string_view text, const std::string& name);

}  // namespace striker::sil
