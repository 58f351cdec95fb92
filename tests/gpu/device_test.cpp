// Which devices the library takes: what it says of instances that are too old and of features that nobody has filled
// in.
// SPDX-License-Identifier: Apache-2.0
#include <span>
#include <string_view>

#include "gpu/gpu_test.h"

namespace lamp::app {
namespace {

class DeviceCheck : public GpuTest {};

/// An instance of its own, without extensions.
class BareInstance {
 public:
  explicit BareInstance(std::uint32_t version, std::span<const char* const> layers = {}) {
    const VkApplicationInfo application{.sType = VK_STRUCTURE_TYPE_APPLICATION_INFO, .apiVersion = version};
    const VkInstanceCreateInfo create{.sType = VK_STRUCTURE_TYPE_INSTANCE_CREATE_INFO,
                                      .pApplicationInfo = &application,
                                      .enabledLayerCount = static_cast<std::uint32_t>(layers.size()),
                                      .ppEnabledLayerNames = layers.data()};
    EXPECT_EQ(vkCreateInstance(&create, nullptr, &instance_), VK_SUCCESS);
  }
  BareInstance(const BareInstance&) = delete;
  BareInstance& operator=(const BareInstance&) = delete;
  ~BareInstance() { vkDestroyInstance(instance_, nullptr); }
  [[nodiscard]] VkInstance handle() const { return instance_; }

 private:
  VkInstance instance_ = VK_NULL_HANDLE;
};

TEST_F(DeviceCheck, InstancesBefore13AreRefused) {
  for (const auto& [version, text] :
       {std::pair(VK_API_VERSION_1_0, "1.0"), {VK_API_VERSION_1_1, "1.1"}, {VK_API_VERSION_1_2, "1.2"}, {0U, "1.0"}}) {
    SCOPED_TRACE(version);
    const BareInstance instance(version);
    const Result<vulkan::Instance> loaded = vulkan::load_instance(vkGetInstanceProcAddr, instance.handle(), version);
    ASSERT_FALSE(loaded.ok());
    EXPECT_EQ(loaded.error().text(),
              std::string("instance: needs Vulkan 1.3 as VkApplicationInfo::apiVersion, was made with ") + text);
  }
}

// A host may load Vulkan in a way of its own; what its loader does not know is named.
TEST_F(DeviceCheck, FunctionsThatAreNotThereAreNamed) {
  const PFN_vkGetInstanceProcAddr without = [](VkInstance instance, const char* name) -> PFN_vkVoidFunction {
    if (std::string_view(name) == "vkGetPhysicalDeviceProperties2") return nullptr;
    return vkGetInstanceProcAddr(instance, name);
  };
  const auto loaded = vulkan::load_instance(without, test_context().instance().handle, VK_API_VERSION_1_3);
  ASSERT_FALSE(loaded.ok());
  EXPECT_EQ(loaded.error().text(),
            "instance: does not know the function vkGetPhysicalDeviceProperties2; expected Vulkan 1.3");
  EXPECT_FALSE(vulkan::load_instance(nullptr, test_context().instance().handle, VK_API_VERSION_1_3).ok());
  EXPECT_FALSE(vulkan::load_instance(vkGetInstanceProcAddr, VK_NULL_HANDLE, VK_API_VERSION_1_3).ok());

  vulkan::Instance instance = test_context().instance();
  instance.vk.vkGetDeviceProcAddr = [](VkDevice device, const char* name) -> PFN_vkVoidFunction {
    if (std::string_view(name) == "vkCmdDispatch") return nullptr;
    return vkGetDeviceProcAddr(device, name);
  };
  const vulkan::Device& device = test_context().device();
  const auto made = vulkan::make_device(instance, device.physical, device.handle);
  ASSERT_FALSE(made.ok());
  EXPECT_EQ(made.error().text(), "device: does not know the function vkCmdDispatch; expected Vulkan 1.3");
}

// The validation layer gives out functions of debug utilities whether the host enabled them or not, and then complains
// of their use.
TEST_F(DeviceCheck, DebugUtilitiesThatAreNotEnabledAreNotUsed) {
  const char* const layers[] = {"VK_LAYER_KHRONOS_validation"};
  const BareInstance bare(VK_API_VERSION_1_3, layers);
  const vulkan::Instance instance =
      take(vulkan::load_instance(vkGetInstanceProcAddr, bare.handle(), VK_API_VERSION_1_3));
  EXPECT_FALSE(instance.debug_utils);
  EXPECT_TRUE(test_context().instance().debug_utils);
  EXPECT_NE(test_context().device().vk.vkCmdBeginDebugUtilsLabelEXT, nullptr);

  std::uint32_t count = 1;
  VkPhysicalDevice physical = VK_NULL_HANDLE;
  EXPECT_GE(vkEnumeratePhysicalDevices(bare.handle(), &count, &physical), VK_SUCCESS);
  const vulkan::RequiredFeatures features;
  const float priority = 1.0F;
  const VkDeviceQueueCreateInfo queue{
      .sType = VK_STRUCTURE_TYPE_DEVICE_QUEUE_CREATE_INFO, .queueCount = 1, .pQueuePriorities = &priority};
  const VkDeviceCreateInfo create{.sType = VK_STRUCTURE_TYPE_DEVICE_CREATE_INFO,
                                  .pNext = &features.base,
                                  .queueCreateInfoCount = 1,
                                  .pQueueCreateInfos = &queue};
  VkDevice handle = VK_NULL_HANDLE;
  ASSERT_EQ(vkCreateDevice(physical, &create, nullptr, &handle), VK_SUCCESS);
  const vulkan::Device device = take(vulkan::make_device(instance, physical, handle));
  EXPECT_EQ(device.vk.vkCmdBeginDebugUtilsLabelEXT, nullptr);
  EXPECT_EQ(device.vk.vkCmdEndDebugUtilsLabelEXT, nullptr);
  EXPECT_EQ(device.vk.vkSetDebugUtilsObjectNameEXT, nullptr);
  vkDestroyDevice(handle, nullptr);
}

TEST_F(DeviceCheck, TheDeviceOfTheTestsPasses) {
  EXPECT_EQ(vulkan::check_device(test_context().instance(), test_context().device().physical), std::nullopt);
}

TEST_F(DeviceCheck, FeaturesThatNoDriverFilledInAreMissing) {
  EXPECT_EQ(vulkan::missing_feature(vulkan::RequiredFeatures()), std::nullopt);
  EXPECT_EQ(vulkan::missing_feature(vulkan::RequiredFeatures(VK_FALSE)), "scalarBlockLayout");
  vulkan::RequiredFeatures has;
  has.vulkan13.maintenance4 = VK_FALSE;
  EXPECT_EQ(vulkan::missing_feature(has), "maintenance4");
  has.vulkan13.dynamicRendering = VK_FALSE;
  EXPECT_EQ(vulkan::missing_feature(has), "dynamicRendering");
}

}  // namespace
}  // namespace lamp::app
