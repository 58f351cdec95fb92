// Which devices the library takes: what it says of instances that are too old and of features that nobody has filled
// in. SPDX-License-Identifier: Apache-2.0
#include <vector>

#include "gpu/gpu_test.h"

namespace lamp::app {
namespace {

class DeviceCheck : public GpuTest {};

/// An instance of its own, and its first device.
class OldInstance {
 public:
  explicit OldInstance(std::uint32_t version) {
    const VkApplicationInfo application{.sType = VK_STRUCTURE_TYPE_APPLICATION_INFO, .apiVersion = version};
    const VkInstanceCreateInfo create{.sType = VK_STRUCTURE_TYPE_INSTANCE_CREATE_INFO,
                                      .pApplicationInfo = &application};
    EXPECT_EQ(vkCreateInstance(&create, nullptr, &instance_), VK_SUCCESS);
    std::uint32_t count = 1;
    vkEnumeratePhysicalDevices(instance_, &count, &physical_);
    EXPECT_EQ(count, 1);
  }
  OldInstance(const OldInstance&) = delete;
  OldInstance& operator=(const OldInstance&) = delete;
  ~OldInstance() { vkDestroyInstance(instance_, nullptr); }
  [[nodiscard]] VkPhysicalDevice physical() const { return physical_; }

 private:
  VkInstance instance_ = VK_NULL_HANDLE;
  VkPhysicalDevice physical_ = VK_NULL_HANDLE;
};

TEST_F(DeviceCheck, InstancesBefore13AreRefused) {
  for (const auto& [version, text] :
       {std::pair(VK_API_VERSION_1_0, "1.0"), {VK_API_VERSION_1_1, "1.1"}, {VK_API_VERSION_1_2, "1.2"}, {0U, "1.0"}}) {
    SCOPED_TRACE(version);
    const OldInstance instance(version);
    const auto error = vulkan::check_device(instance.physical(), version);
    ASSERT_TRUE(error.has_value());
    EXPECT_EQ(error->text(),
              std::string("instance: needs Vulkan 1.3 as VkApplicationInfo::apiVersion, was made with ") + text);
    const Result<vulkan::Device> device = vulkan::make_device(instance.physical(), VK_NULL_HANDLE, version);
    ASSERT_FALSE(device.ok());
    EXPECT_EQ(device.error().text(), error->text());
  }
}

TEST_F(DeviceCheck, TheDeviceOfTheTestsPasses) {
  EXPECT_EQ(vulkan::check_device(test_context().device().physical, VK_API_VERSION_1_3), std::nullopt);
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
