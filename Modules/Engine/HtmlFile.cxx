#include "HtmlFile.h"

#include "Base64.h"
#include "Common/Core/Error.h"
#include "GltfFile.h"

#include <nlohmann/json.hpp>

extern const char kLitModelPage[];  ///< empty where the build had nothing to make it of

namespace lambert {
namespace {
using Json = nlohmann::ordered_json;

/// Text between tags of HTML.
std::string Escaped(const std::string& text) {
  std::string escaped;
  for (char c : text) {
    switch (c) {
      case '&':
        escaped += "&amp;";
        break;
      case '<':
        escaped += "&lt;";
        break;
      case '>':
        escaped += "&gt;";
        break;
      default:
        escaped += c;
    }
  }
  return escaped;
}

/// Where the page looks from: what a camera of glTF does not tell.
std::string SceneJson(const Camera& camera) {
  const auto toJson = [](const Vec3d& v) { return Json::array({v.x, v.y, v.z}); };
  return Json({{"eye", toJson(camera.position)},
               {"focalPoint", toJson(camera.focalPoint)},
               {"up", toJson(Normalize(camera.viewUp))}})
      .dump();
}

/// The text of a page with `parts` for its marks; what they bring is not looked at again.
std::string Filled(const std::string& page,
                   const std::vector<std::pair<std::string, std::string>>& parts) {
  std::string filled;
  for (size_t from = 0; from < page.size();) {
    // The next mark of any kind.
    size_t next = page.size();
    const std::pair<std::string, std::string>* found = nullptr;
    for (const auto& part : parts) {
      const size_t at = page.find(part.first, from);
      if (at < next) {
        next = at;
        found = &part;
      }
    }
    filled.append(page, from, next - from);
    from = next;
    if (found) {
      filled += found->second;
      from += found->first.size();
    }
  }
  return filled;
}
}  // namespace

void RequireHtmlPage() {
  if (!*kLitModelPage) {
    throw Error("This build has no page for browsers: run Utilities/setup and build anew.");
  }
}

std::string HtmlOf(const LitModel& model) {
  RequireHtmlPage();
  return Filled(kLitModelPage, {{"@NAME@", Escaped(model.name)},
                                {"@SCENE@", SceneJson(model.camera)},
                                {"@MODEL@", Base64(GlbOf(model))}});
}
}  // namespace lambert
