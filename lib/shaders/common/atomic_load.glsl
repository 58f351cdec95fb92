// Reads of what other invocations may be changing with atomics at the same time, and such writes: without a barrier between
// them plain ones would be a data race. As cheap as a read past the first cache.
// SPDX-License-Identifier: Apache-2.0
#ifndef LAMP_COMMON_ATOMIC_LOAD
#define LAMP_COMMON_ATOMIC_LOAD
#extension GL_KHR_memory_scope_semantics : require

#define LOAD_OF_DEVICE(place) atomicLoad(place, gl_ScopeDevice, gl_StorageSemanticsNone, gl_SemanticsRelaxed)
#define STORE_OF_DEVICE(place, value) \
  atomicStore(place, value, gl_ScopeDevice, gl_StorageSemanticsNone, gl_SemanticsRelaxed)
#define LOAD_OF_GROUP(place) atomicLoad(place, gl_ScopeWorkgroup, gl_StorageSemanticsNone, gl_SemanticsRelaxed)

#endif
