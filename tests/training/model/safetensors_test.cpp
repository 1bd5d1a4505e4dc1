// SPDX-License-Identifier: Apache-2.0
// The safetensors reader and writer: round trips, and every malformed file refused in one line.
#include "training/model/safetensors.hpp"

#include <cmath>
#include <cstring>
#include <limits>
#include <nlohmann/json.hpp>

#include "tests/training/fixtures.hpp"

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
      {"NameTwice",
       file_of(R"({"b":{"dtype":"F32","shape":[1],"data_offsets":[0,4]},"a":{"dtype":"F32","shape":[1],)"
               R"("data_offsets":[4,8]},"b":{"dtype":"F32","shape":[1],"data_offsets":[0,4]}})",
               eight),
       "names b twice"},
      {"NameTwiceElsewhere",
       file_of(R"({"a":{"dtype":"F32","shape":[2],"data_offsets":[0,8]},"b":{"dtype":"F32","shape":[2],)"
               R"("data_offsets":[0,8]},"b":{"dtype":"F32","shape":[1],"data_offsets":[0,4]}})",
               eight),
       "names b twice"},
      {"FieldTwice",
       file_of(R"({"a":{"dtype":"F32","dtype":"F16","shape":[2],"data_offsets":[0,8]}})", eight),
       "names dtype twice"},
      {"Zip", "PK\x03\x04" + std::string(100, '\x06'), "zip archive, as torch.save writes it"},
      {"Pickle", "\x80\x04\x95" + std::string(100, '\x06'), "Python pickle"},
      {"Json", R"({"metadata": {"total_size": 12}, "weight_map": {}})", "JSON text"},
      {"Hdf5", "\x89HDF\r\n\x1a\n" + std::string(100, '\x06'), "HDF5"},
      {"Numpy", "\x93NUMPY" + std::string(100, '\x06'), "NumPy"},
      {"Gzip", "\x1f\x8b" + std::string(100, '\x06'), "gunzip"},
      {"LfsPointer", "version https://git-lfs.github.com/spec/v1\n", "git lfs pull"},
      {"NaN", file_of(one, with_nan), "NaN"},
      {"Infinity", file_of(one, with_infinity), "infinite"},
  };
}

class MalformedSafetensors : public testing::TestWithParam<Malformed> {};

TEST_P(MalformedSafetensors, IsRefusedInOneLine) {
  expect_refused([] { (void)read_safetensors(GetParam().bytes, "some.safetensors"); }, "some.safetensors",
                 {GetParam().complaint});
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

// A length that begins like a pickle is none: 640 bytes of header.
TEST(Safetensors, ALengthThatLooksLikeAnotherFormatIsALength) {
  std::string header = R"({"a":{"dtype":"F32","shape":[2],"data_offsets":[0,8]}})";
  header.resize(0x280, ' ');
  EXPECT_EQ(read_safetensors(file_of(header, eight), "f").tensors.size(), 1U);
}

// Equal names in different objects are no repetition.
TEST(Safetensors, FieldsOfSeveralTensorsAreNoRepetition) {
  const std::string two = R"({"a":{"dtype":"F32","shape":[1],"data_offsets":[0,4]},)"
                          R"("b":{"dtype":"F32","shape":[1],"data_offsets":[4,8]}})";
  EXPECT_EQ(read_safetensors(file_of(two, eight), "f").tensors.size(), 2U);
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

}  // namespace
}  // namespace striker::training
