// Lit models as pages for a browser, self-contained. C++ only.
#ifndef HtmlFile_h
#define HtmlFile_h

#include "LitModel.h"

namespace lambert {
/// Throws Error where this build has no page: Node.js or the packages of Utilities/web were missing.
LAMBERTENGINE_EXPORT void RequireHtmlPage();

/// `model` as an HTML page that shows it from its camera, to be turned around or walked in. Needs a
/// browser with WebGL 2 and no network: three.js lies in it, the model as GLB in base64. Throws
/// as RequireHtmlPage and GlbOf do.
LAMBERTENGINE_EXPORT std::string HtmlOf(const LitModel& model);
}  // namespace lambert

#endif
