// Made of src/report/templates when the build is configured: what is said of a study while it runs.
#pragma once

namespace launchsafe::report {

extern const char* const status_text_template;
extern const char* const status_page_template;

}  // namespace launchsafe::report
