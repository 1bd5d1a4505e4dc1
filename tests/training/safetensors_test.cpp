// The safetensors reader and writer: round trips, and every malformed file refused in one line.
#include "safetensors.hpp"

#include <cmath>
#include <cstring>
#include <limits>
#include <nlohmann/json.hpp>

#include "fixtures.hpp"

namespace striker::training {
namespace {

// A file from a header's text and data, whatever they say.
std::string file_of(const std::string& header, const std::string& data) {
  const std::uint64_t length = header.size();
  std::string bytes(8, '\0');
  std::memcpy(bytes.data(), &length, 8);
  return bytes + header + data;
}

const std::string eight(8, '\0');  // two floats

struct Malformed {
  const char* name;
  std::string bytes;
  const char* complaint;
};

std::vector<Malformed> malformed() {
  const std::string one = R"({"a":{"dtype":"F32","shape":[2],"data_offsets":[0,8]}})";
  const float nan = std::numeric_limits<float>::quiet_NaN();
  const float infinity = -std::numeric_limits<float>::infinity();
  std::string with_nan = eight;
  std::memcpy(with_nan.data() + 4, &nan, 4);
  std::string with_infinity = eight;
  std::memcpy(with_infinity.data(), &infinity, 4);
  return {
      {"Empty", "", "truncated"},
      {"ShortLength", "1234567", "truncated"},
      {"HeaderBeyondTheFile", file_of(one, "").substr(0, 30), "truncated"},
      {"HugeHeader", std::string(8, '\xff') + one, "truncated"},
      {"NoJson", file_of("{\"a\":", eight), "not a JSON object"},
      {"NoObject", file_of("[1, 2]", eight), "not a JSON object"},
      {"TruncatedData", file_of(one, eight.substr(0, 7)), "outside the file"},
      {"TrailingData", file_of(one, eight + "x"), "belong to no tensor"},
      {"EntryIsNoObject", file_of(R"({"a":3})", eight), "dtype"},
      {"OtherType", file_of(R"({"a":{"dtype":"F16","shape":[4],"data_offsets":[0,8]}})", eight), "F16"},
      {"NoShape", file_of(R"({"a":{"dtype":"F32","data_offsets":[0,8]}})", eight), "no shape"},
      {"NoOffsets", file_of(R"({"a":{"dtype":"F32","shape":[2]}})", eight), "no data_offsets"},
      {"NegativeSize", file_of(R"({"a":{"dtype":"F32","shape":[-2],"data_offsets":[0,8]}})", eight), "-2"},
      {"OneOffset", file_of(R"({"a":{"dtype":"F32","shape":[2],"data_offsets":[8]}})", eight),
       "outside the file"},
      {"OffsetsSwapped", file_of(R"({"a":{"dtype":"F32","shape":[2],"data_offsets":[8,0]}})", eight),
       "outside the file"},
      {"ShapeTooSmall", file_of(R"({"a":{"dtype":"F32","shape":[1],"data_offsets":[0,8]}})", eight),
       "shape [1]"},
      {"ShapeOverflows",
       file_of(R"({"a":{"dtype":"F32","shape":[4294967296,4294967296,4],"data_offsets":[0,8]}})", eight),
       "does not fit"},
      {"Overlap",
       file_of(R"({"a":{"dtype":"F32","shape":[2],"data_offsets":[0,8]},)"
               R"("b":{"dtype":"F32","shape":[1],"data_offsets":[4,8]}})",
               eight),
       "overlap"},
      {"Gap", file_of(R"({"a":{"dtype":"F32","shape":[1],"data_offsets":[4,8]}})", eight), "gap"},
      {"NaN", file_of(one, with_nan), "NaN"},
      {"Infinity", file_of(one, with_infinity), "infinite"},
  };
}

class MalformedSafetensors : public testing::TestWithParam<Malformed> {};

TEST_P(MalformedSafetensors, IsRefusedInOneLine) {
  try {
    (void)read_safetensors(GetParam().bytes, "some.safetensors");
    FAIL() << "was read";
  } catch (const std::runtime_error& error) {
    const std::string message = error.what();
    EXPECT_EQ(message.find("some.safetensors: "), 0U) << message;
    EXPECT_NE(message.find(GetParam().complaint), std::string::npos) << message;
    EXPECT_EQ(message.find('\n'), std::string::npos) << message;
  }
}

INSTANTIATE_TEST_SUITE_P(Safetensors, MalformedSafetensors, testing::ValuesIn(malformed()),
                         [](const auto& tested) { return tested.param.name; });

TEST(Safetensors, WhatIsWrittenIsRead) {
  SafeTensors content{.tensors = {{.name = "z", .shape = {2, 3}, .values = {1, 2, 3, 4, 5, 6}},
                                  {.name = "a", .shape = {1}, .values = {-0.5F}}},
                      .metadata = {{"text", "line\n\"quoted\""}, {"seed", "7"}}};
  const std::string bytes = write_safetensors(content);
  const SafeTensors read = read_safetensors(bytes, "f");
  ASSERT_EQ(read.tensors.size(), 2U);
  EXPECT_EQ(read.tensors[0].name, "z");
  EXPECT_EQ(read.tensors[0].shape, content.tensors[0].shape);
  EXPECT_EQ(read.tensors[0].values, content.tensors[0].values);
  EXPECT_EQ(read.tensors[1].values, content.tensors[1].values);
  EXPECT_EQ(read.metadata, content.metadata);
  std::uint64_t length = 0;
  std::memcpy(&length, bytes.data(), 8);
  EXPECT_EQ(length % 8, 0U) << "the data are not aligned";
}

TEST(Safetensors, EveryTruncationOfAModelIsRefused) {
  const TemporaryDirectory directory;
  const auto file = directory / "model.safetensors";
  save_model({.parameters = some_parameters(1), .metadata = {{"seed", "1"}}}, file);
  const std::string whole = content_of(file);
  for (std::size_t size = 0; size < whole.size(); size += 97) {
    EXPECT_THROW((void)read_safetensors(whole.substr(0, size), "f"), std::runtime_error) << size;
  }
}

TEST(Model, ComesBackBitForBit) {
  const TemporaryDirectory directory;
  const Model model{.parameters = some_parameters(1), .metadata = {{"seed", "1"}, {"equations", "printed"}}};
  save_model(model, directory / "model.safetensors");
  const Model read = load_model(directory / "model.safetensors");
  EXPECT_EQ(read.parameters, model.parameters);
  EXPECT_EQ(read.metadata, model.metadata);
  EXPECT_EQ(equations_of(read), Equations::printed);
  EXPECT_EQ(model_identity(read.parameters), model_identity(model.parameters));
  Parameters other = model.parameters;
  other(4000) = std::nextafter(other(4000), 1.0F);
  EXPECT_NE(model_identity(other), model_identity(model.parameters));
}

// PyTorch's layout: a row of "0.weight" holds what one neuron reads.
TEST(Model, WeightsAreNamedAndLaidOutAsInPyTorch) {
  const TemporaryDirectory directory;
  Parameters parameters = Parameters::Zero();
  weights<0>(parameters)(3, 5) = 7.0F;
  biases<2>(parameters)(2) = 9.0F;
  save_model({.parameters = parameters, .metadata = {}}, directory / "m");
  const SafeTensors content = read_safetensors(content_of(directory / "m"), "m");
  ASSERT_EQ(content.tensors.size(), 6U);
  EXPECT_EQ(content.tensors[0].name, "0.weight");
  EXPECT_EQ(content.tensors[0].shape, (std::vector<std::size_t>{64, 6}));
  EXPECT_EQ(content.tensors[0].values[3 * 6 + 5], 7.0F);
  EXPECT_EQ(content.tensors[5].name, "4.bias");
  EXPECT_EQ(content.tensors[5].values[2], 9.0F);
}

TEST(Model, OfAnotherShapeIsRefused) {
  const TemporaryDirectory directory;
  save_model({.parameters = some_parameters(1), .metadata = {}}, directory / "m");
  const SafeTensors good = read_safetensors(content_of(directory / "m"), "m");
  const auto complaint = [&](const SafeTensors& content) {
    write_to(directory / "bad", write_safetensors(content));
    try {
      (void)load_model(directory / "bad");
    } catch (const std::runtime_error& error) {
      return std::string(error.what());
    }
    return std::string("was read");
  };
  SafeTensors missing = good;
  missing.tensors.pop_back();
  EXPECT_NE(complaint(missing).find("4.bias is missing"), std::string::npos);
  SafeTensors more = good;
  more.tensors.push_back({.name = "6.bias", .shape = {1}, .values = {0.0F}});
  EXPECT_NE(complaint(more).find("7 tensors"), std::string::npos);
  SafeTensors turned = good;
  turned.tensors[0].shape = {6, 64};
  EXPECT_NE(complaint(turned).find("0.weight has shape [6, 64]"), std::string::npos);
}

}  // namespace
}  // namespace striker::training
