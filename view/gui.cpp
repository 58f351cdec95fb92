// A render pass that keeps what is below, because Dear ImGui 1.86 knows no dynamic rendering, and no user's textures
// either: the picture is a blit.
// SPDX-License-Identifier: Apache-2.0
#include "view/gui.h"

#include <backends/imgui_impl_vulkan.h>
#include <imgui.h>
#include <glm/glm.hpp>

#include <algorithm>
#include <limits>

#include "gpu/check.h"

namespace lamp::app {
namespace {

constexpr std::uint32_t FRAMES = 3;  // whose vertices are kept: one more than are under way
constexpr VkClearColorValue BACKGROUND{{0.07F, 0.07F, 0.08F, 1.0F}};

void check_result(VkResult result) { check(result, "drawing the interface"); }

/// ImGui's numbers of keys, each by ours.
void set_key_map(ImGuiIO& io) {
  constexpr std::pair<ImGuiKey_, std::string_view> KEYS[] = {{ImGuiKey_Tab, "tab"},
                                                             {ImGuiKey_LeftArrow, "left"},
                                                             {ImGuiKey_RightArrow, "right"},
                                                             {ImGuiKey_UpArrow, "up"},
                                                             {ImGuiKey_DownArrow, "down"},
                                                             {ImGuiKey_PageUp, "page-up"},
                                                             {ImGuiKey_PageDown, "page-down"},
                                                             {ImGuiKey_Home, "home"},
                                                             {ImGuiKey_End, "end"},
                                                             {ImGuiKey_Delete, "delete"},
                                                             {ImGuiKey_Backspace, "backspace"},
                                                             {ImGuiKey_Space, "space"},
                                                             {ImGuiKey_Enter, "enter"},
                                                             {ImGuiKey_Escape, "escape"},
                                                             {ImGuiKey_A, "a"},
                                                             {ImGuiKey_C, "c"},
                                                             {ImGuiKey_V, "v"},
                                                             {ImGuiKey_X, "x"},
                                                             {ImGuiKey_Y, "y"},
                                                             {ImGuiKey_Z, "z"}};
  for (const auto& [key, name] : KEYS) io.KeyMap[key] = static_cast<int>(key_number(name).value());
}

void transfer_barrier(VkCommandBuffer commands, VkImage image, VkImageLayout from) {
  const VkImageMemoryBarrier2 barrier{
      .sType = VK_STRUCTURE_TYPE_IMAGE_MEMORY_BARRIER_2,
      .srcStageMask = VK_PIPELINE_STAGE_2_ALL_TRANSFER_BIT | VK_PIPELINE_STAGE_2_COLOR_ATTACHMENT_OUTPUT_BIT,
      .srcAccessMask = VK_ACCESS_2_TRANSFER_WRITE_BIT,
      .dstStageMask = VK_PIPELINE_STAGE_2_ALL_TRANSFER_BIT,
      .dstAccessMask = VK_ACCESS_2_TRANSFER_WRITE_BIT,
      .oldLayout = from,
      .newLayout = VK_IMAGE_LAYOUT_TRANSFER_DST_OPTIMAL,
      .image = image,
      .subresourceRange = {VK_IMAGE_ASPECT_COLOR_BIT, 0, 1, 0, 1}};
  const VkDependencyInfo dependency{
      .sType = VK_STRUCTURE_TYPE_DEPENDENCY_INFO, .imageMemoryBarrierCount = 1, .pImageMemoryBarriers = &barrier};
  vkCmdPipelineBarrier2(commands, &dependency);
}

void record_picture(VkCommandBuffer commands, const Canvas& canvas, const GpuImage& picture, const ScreenRect& where) {
  const VkImageSubresourceLayers layer{VK_IMAGE_ASPECT_COLOR_BIT, 0, 0, 1};
  const auto width = static_cast<std::int32_t>(picture.info().width);
  const auto height = static_cast<std::int32_t>(picture.info().height);
  const VkImageBlit2 region{.sType = VK_STRUCTURE_TYPE_IMAGE_BLIT_2,
                            .srcSubresource = layer,
                            .srcOffsets = {{0, 0, 0}, {width, height, 1}},
                            .dstSubresource = layer,
                            .dstOffsets = {{where.min.x, where.min.y, 0}, {where.max.x, where.max.y, 1}}};
  // Pixels of a picture that is shown larger than it is stay visible as such.
  const bool smaller = where.size().x < width;
  const VkBlitImageInfo2 blit{.sType = VK_STRUCTURE_TYPE_BLIT_IMAGE_INFO_2,
                              .srcImage = picture.handle(),
                              .srcImageLayout = VK_IMAGE_LAYOUT_TRANSFER_SRC_OPTIMAL,
                              .dstImage = canvas.image,
                              .dstImageLayout = VK_IMAGE_LAYOUT_TRANSFER_DST_OPTIMAL,
                              .regionCount = 1,
                              .pRegions = &region,
                              .filter = smaller ? VK_FILTER_LINEAR : VK_FILTER_NEAREST};
  vkCmdBlitImage2(commands, &blit);
}

}  // namespace

Gui::Gui(Context& context, VkFormat format, VkImageLayout end, float scale) : context_(context) {
  make_render_pass(format, end);
  timestamps_ = take(vulkan::Timestamps::create(context.device(), 1));
  IMGUI_CHECKVERSION();
  ImGui::CreateContext();
  ImGuiIO& io = ImGui::GetIO();
  io.IniFilename = nullptr;  // settings are ours to keep
  io.LogFilename = nullptr;
  io.ConfigFlags |= ImGuiConfigFlags_NavEnableKeyboard;
  io.BackendPlatformName = "lamp-view";
  set_key_map(io);
  ImGui::StyleColorsDark();
  ImGui::GetStyle().WindowRounding = 0.0F;
  ImGui::GetStyle().ScaleAllSizes(scale);
  ImFontConfig font;
  font.SizePixels = 13.0F * scale;
  io.Fonts->AddFontDefault(&font);
  make_backend();
}

void Gui::make_render_pass(VkFormat format, VkImageLayout end) {
  const VkAttachmentDescription color{.format = format,
                                      .samples = VK_SAMPLE_COUNT_1_BIT,
                                      .loadOp = VK_ATTACHMENT_LOAD_OP_LOAD,
                                      .storeOp = VK_ATTACHMENT_STORE_OP_STORE,
                                      .stencilLoadOp = VK_ATTACHMENT_LOAD_OP_DONT_CARE,
                                      .stencilStoreOp = VK_ATTACHMENT_STORE_OP_DONT_CARE,
                                      .initialLayout = VK_IMAGE_LAYOUT_TRANSFER_DST_OPTIMAL,
                                      .finalLayout = end};
  const VkAttachmentReference reference{0, VK_IMAGE_LAYOUT_COLOR_ATTACHMENT_OPTIMAL};
  const VkSubpassDescription subpass{
      .pipelineBindPoint = VK_PIPELINE_BIND_POINT_GRAPHICS, .colorAttachmentCount = 1, .pColorAttachments = &reference};
  constexpr VkAccessFlags COLOR = VK_ACCESS_COLOR_ATTACHMENT_READ_BIT | VK_ACCESS_COLOR_ATTACHMENT_WRITE_BIT;
  const VkSubpassDependency dependencies[] = {{.srcSubpass = VK_SUBPASS_EXTERNAL,
                                               .dstSubpass = 0,
                                               .srcStageMask = VK_PIPELINE_STAGE_TRANSFER_BIT,
                                               .dstStageMask = VK_PIPELINE_STAGE_COLOR_ATTACHMENT_OUTPUT_BIT,
                                               .srcAccessMask = VK_ACCESS_TRANSFER_WRITE_BIT,
                                               .dstAccessMask = COLOR},
                                              {.srcSubpass = 0,
                                               .dstSubpass = VK_SUBPASS_EXTERNAL,
                                               .srcStageMask = VK_PIPELINE_STAGE_COLOR_ATTACHMENT_OUTPUT_BIT,
                                               .dstStageMask = VK_PIPELINE_STAGE_TRANSFER_BIT,
                                               .srcAccessMask = VK_ACCESS_COLOR_ATTACHMENT_WRITE_BIT,
                                               .dstAccessMask = VK_ACCESS_TRANSFER_READ_BIT}};
  const VkRenderPassCreateInfo create{.sType = VK_STRUCTURE_TYPE_RENDER_PASS_CREATE_INFO,
                                      .attachmentCount = 1,
                                      .pAttachments = &color,
                                      .subpassCount = 1,
                                      .pSubpasses = &subpass,
                                      .dependencyCount = 2,
                                      .pDependencies = dependencies};
  check(vkCreateRenderPass(context_.device().handle, &create, nullptr, &render_pass_), "interface: render pass");
}

void Gui::make_backend() {
  const VkDescriptorPoolSize size{VK_DESCRIPTOR_TYPE_COMBINED_IMAGE_SAMPLER, 4};
  const VkDescriptorPoolCreateInfo pool{.sType = VK_STRUCTURE_TYPE_DESCRIPTOR_POOL_CREATE_INFO,
                                        .flags = VK_DESCRIPTOR_POOL_CREATE_FREE_DESCRIPTOR_SET_BIT,
                                        .maxSets = 4,
                                        .poolSizeCount = 1,
                                        .pPoolSizes = &size};
  check(vkCreateDescriptorPool(context_.device().handle, &pool, nullptr, &pool_), "interface: descriptors");
  ImGui_ImplVulkan_InitInfo info{};
  info.Instance = context_.instance().handle;
  info.PhysicalDevice = context_.device().physical;
  info.Device = context_.device().handle;
  info.QueueFamily = context_.queue_family();
  info.Queue = context_.queue();
  info.DescriptorPool = pool_;
  info.MinImageCount = FRAMES;
  info.ImageCount = FRAMES;
  info.MSAASamples = VK_SAMPLE_COUNT_1_BIT;
  info.CheckVkResultFn = check_result;
  ImGui_ImplVulkan_Init(&info, render_pass_);
  context_.submit([](VkCommandBuffer commands) { ImGui_ImplVulkan_CreateFontsTexture(commands); });
  ImGui_ImplVulkan_DestroyFontUploadObjects();
}

Gui::~Gui() {
  ImGui_ImplVulkan_Shutdown();
  ImGui::DestroyContext();
  vkDestroyDescriptorPool(context_.device().handle, pool_, nullptr);
  vkDestroyRenderPass(context_.device().handle, render_pass_, nullptr);
}

void Gui::begin(const Input& input, glm::uvec2 size, float seconds) {
  ImGuiIO& io = ImGui::GetIO();
  io.DisplaySize = ImVec2(static_cast<float>(size.x), static_cast<float>(size.y));
  io.DeltaTime = std::max(seconds, 1e-4F);
  constexpr float NOWHERE = -std::numeric_limits<float>::max();
  io.MousePos = input.mouse ? ImVec2(input.mouse->x, input.mouse->y) : ImVec2(NOWHERE, NOWHERE);
  for (std::size_t i = 0; i < input.buttons.size(); ++i) io.MouseDown[i] = input.buttons[i];
  io.MouseWheel = input.wheel.y;
  io.MouseWheelH = input.wheel.x;
  io.KeyCtrl = input.holds("ctrl");
  io.KeyShift = input.holds("shift");
  io.KeyAlt = input.holds("alt");
  const std::span<const std::string_view> names = key_names();
  for (std::size_t i = 0; i < names.size(); ++i) io.KeysDown[i] = input.holds(names[i]);
  io.AddInputCharactersUTF8(input.text.c_str());
  ImGui_ImplVulkan_NewFrame();
  ImGui::NewFrame();
}

bool interface_has_focus() { return ImGui::GetIO().NavVisible; }
bool interface_takes_text() { return ImGui::GetIO().WantTextInput; }
bool interface_is_used() { return ImGui::IsAnyItemActive(); }

std::string clipboard() {
  const char* const text = ImGui::GetClipboardText();
  return text == nullptr ? "" : text;
}
void set_clipboard(const std::string& text) { ImGui::SetClipboardText(text.c_str()); }

void Gui::end() { ImGui::Render(); }

void Gui::record(VkCommandBuffer commands, const Canvas& canvas, const GpuImage* picture, const ScreenRect& where) {
  if (recorded_)
    if (const auto times = timestamps_.read(); !times.empty()) interface_ms_ = times.front().ms();
  timestamps_.reset(commands);
  constexpr VkImageSubresourceRange WHOLE{VK_IMAGE_ASPECT_COLOR_BIT, 0, 1, 0, 1};
  transfer_barrier(commands, canvas.image, VK_IMAGE_LAYOUT_UNDEFINED);
  vkCmdClearColorImage(commands, canvas.image, VK_IMAGE_LAYOUT_TRANSFER_DST_OPTIMAL, &BACKGROUND, 1, &WHOLE);
  if (picture != nullptr && !where.empty()) {
    transfer_barrier(commands, canvas.image, VK_IMAGE_LAYOUT_TRANSFER_DST_OPTIMAL);
    record_picture(commands, canvas, *picture, where);
  }
  const VkRenderPassBeginInfo begin{.sType = VK_STRUCTURE_TYPE_RENDER_PASS_BEGIN_INFO,
                                    .renderPass = render_pass_,
                                    .framebuffer = canvas.framebuffer,
                                    .renderArea = {{0, 0}, {canvas.size.x, canvas.size.y}}};
  timestamps_.begin(commands, "interface");
  vkCmdBeginRenderPass(commands, &begin, VK_SUBPASS_CONTENTS_INLINE);
  ImGui_ImplVulkan_RenderDrawData(ImGui::GetDrawData(), commands);
  vkCmdEndRenderPass(commands);
  timestamps_.end(commands);
  timestamps_.finish(commands);
  recorded_ = true;
}

}  // namespace lamp::app
