// SPDX-License-Identifier: MIT
#include "tests/gpu/fixture.hpp"

#include <cstdlib>
#include <filesystem>

namespace mote::gpu {

const Instance& DeviceTest::instance() {
  static const Instance made = [] {
    Error error;
    Instance result = Instance::create({.application = "gpu_device", .validation = true}, error);
    if (!result) {
      ADD_FAILURE() << to_string(error);
      std::abort(); // no test of this program can say anything
    }
    return result;
  }();
  return made;
}

const Adapter& DeviceTest::adapter() {
  static const Adapter made = [] {
    Error error;
    Adapter result = instance().request_adapter({}, error);
    if (!result) {
      ADD_FAILURE() << to_string(error);
      std::abort();
    }
    return result;
  }();
  return made;
}

Device DeviceTest::make_device(const DeviceDescriptor& descriptor) {
  Error error;
  Device made = adapter().request_device(descriptor, error);
  EXPECT_TRUE(made) << to_string(error);
  if (made) made.on_uncaptured_error([this](const Error& e) { uncaptured_.push_back(e); });
  return made;
}

void DeviceTest::SetUp() {
  messages_before_ = instance().validation_messages().size();
  device = make_device({.label = "test", .required_features = all_features(), .fill_new_memory = true});
  ASSERT_TRUE(device);
}

void DeviceTest::TearDown() {
  if (device) device.queue().wait_idle();
  device = {};
  for (const Error& error : uncaptured_) ADD_FAILURE() << "uncaptured: " << to_string(error);
  const auto messages = instance().validation_messages();
  for (std::size_t i = messages_before_; i < messages.size(); ++i) ADD_FAILURE() << "validation layer: " << messages[i];
}

ShaderModule DeviceTest::shader(ShaderStage stage, const std::string& glsl, std::string_view label) {
  const CompiledShader compiled = compile_glsl(stage, {std::string(label), glsl});
  for (const ShaderMessage& message : compiled.messages) ADD_FAILURE() << to_string(message);
  return device.create_shader_module({.label = label, .spirv = compiled.spirv});
}

Texture DeviceTest::target(TextureFormat format, std::uint32_t width, std::uint32_t height, std::string_view label) {
  return device.create_texture({.label = label,
                                .size = {width, height, 1},
                                .format = format,
                                .usage = TextureUsage::RenderAttachment | TextureUsage::CopySrc});
}

void DeviceTest::submit_and_wait(CommandEncoder& encoder) {
  const CommandBuffer commands = encoder.finish();
  ASSERT_TRUE(commands);
  device.queue().wait(device.queue().submit(commands));
}

std::string DeviceTest::output(const std::string& name) {
  const auto* info = testing::UnitTest::GetInstance()->current_test_info();
  const std::filesystem::path folder = std::filesystem::path(MOTE_BINARY_DIR) / "test_output" / info->name();
  std::filesystem::remove_all(folder / name);
  std::filesystem::create_directories(folder);
  return (folder / name).string();
}

} // namespace mote::gpu
