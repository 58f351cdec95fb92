// Look-ups are read for the view of the frame's record. Before a look-up is included.
// Needs: `frame`.
// SPDX-License-Identifier: Apache-2.0
#ifndef LAMP_SHOWN_VIEW
#define LAMP_SHOWN_VIEW

layout(constant_id = 18) const bool SEVERAL_VIEWS = false;  // else nothing asks which
#define LOOKUP_VIEW (SEVERAL_VIEWS ? frame.view_index : 0u)
#define LOOKUP_POSITION_FRAME(view) frame  // of the sample that is drawn

#endif
