// SPDX-License-Identifier: Apache-2.0
// A model file from anywhere is read, or refused with a message that names it; what was read is written as itself,
// and is a network with its task, or is refused again.
#include "training/model/safetensors.hpp"

#include <stdexcept>

#include "tests/fuzz/support/bytes.hpp"
#include "training/export/firmware_limits.hpp"
#include "training/model/model.hpp"
#include "training/run/model_task.hpp"

namespace striker::fuzz {
namespace {

void take_as_model(const training::SafeTensors& content) {
  try {
    const training::Model model = {.parameters = training::parameters_of(content.tensors, "fuzz.safetensors"),
                                   .metadata = content.metadata};
    require(training::model_identity(model.parameters).size() == 8, "a model has an identity");
    training::require_firmware_serves(training::task_of(model, "a model", {}));
  } catch (const std::runtime_error&) {
    return;
  }
}

}  // namespace
}  // namespace striker::fuzz

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  using namespace striker;
  const std::string_view bytes(reinterpret_cast<const char*>(data), size);
  try {
    const training::SafeTensors content = training::read_safetensors(bytes, "fuzz.safetensors");
    const std::string written = training::write_safetensors(content);
    fuzz::require(training::write_safetensors(training::read_safetensors(written, "written")) == written,
                  "what was written reads as itself");
    fuzz::take_as_model(content);
  } catch (const std::runtime_error& error) {
    fuzz::require(std::string_view(error.what()).starts_with("fuzz.safetensors: "),
                  "an error names its file");
  }
  return 0;
}
