// States by name.
// SPDX-License-Identifier: Apache-2.0
#include <algorithm>

#include "view/panels.h"

namespace lamp::app {

void bookmark_panel(PanelFrame& p) {
  if (!p.widgets.header("Bookmarks", false)) return;
  for (std::size_t i = 0; i < p.bookmarks.size(); ++i) {
    const std::string& name = p.bookmarks[i].name;
    if (!p.widgets.pick(name, name == p.bookmark)) continue;
    p.bookmark = name;
    p.wishes.open_bookmark = i;
  }
  p.widgets.write("name", p.bookmark, "Of the bookmark that is added or removed.");
  const bool known = std::ranges::find(p.bookmarks, p.bookmark, &Bookmark::name) != p.bookmarks.end();
  if (p.widgets.button("add bookmark", "Keeps all that is set under this name; one of that name is replaced.",
                       p.bookmark.empty() ? "it has no name" : ""))
    p.wishes.add_bookmark = true;
  if (p.widgets.button("remove bookmark", "Forgets the bookmark of this name.",
                       known ? "" : "there is none of that name"))
    p.wishes.remove_bookmark = true;
  p.widgets.write("bookmark file", p.files.bookmarks, "A name that ends in .json. Drop such a file to open it.");
  if (p.widgets.button("save bookmarks", "Writes all of them. lamp-view --bookmarks opens them.",
                       p.bookmarks.empty() ? "there are none" : ""))
    p.wishes.save_bookmarks = true;
}

}  // namespace lamp::app
