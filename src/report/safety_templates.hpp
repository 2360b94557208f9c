// The templates that are built in, of src/report/templates.
#pragma once

namespace launchsafe::report::safety {

extern const char* const built_in_html;
extern const char* const built_in_markdown;
extern const char* const built_in_texts;

}  // namespace launchsafe::report::safety
