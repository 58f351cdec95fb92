// Lamplight for Vulkan 1.3: lights and views, device requirements, the Culler, and below it plan runner, recorder,
// pipelines, buffers.
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "lamplight/light.h"                       // IWYU pragma: export
#include "lamplight/view.h"                        // IWYU pragma: export
#include "lamplight/vulkan/bound_lookup.h"         // IWYU pragma: export
#include "lamplight/vulkan/buffer.h"               // IWYU pragma: export
#include "lamplight/vulkan/culler.h"               // IWYU pragma: export
#include "lamplight/vulkan/descriptor_sets.h"      // IWYU pragma: export
#include "lamplight/vulkan/device.h"               // IWYU pragma: export
#include "lamplight/vulkan/functions.h"            // IWYU pragma: export
#include "lamplight/vulkan/pass_pipeline.h"        // IWYU pragma: export
#include "lamplight/vulkan/pipeline.h"             // IWYU pragma: export
#include "lamplight/vulkan/pipeline_statistics.h"  // IWYU pragma: export
#include "lamplight/vulkan/plan_runner.h"          // IWYU pragma: export
#include "lamplight/vulkan/recorder.h"             // IWYU pragma: export
