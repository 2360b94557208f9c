# The modules, from the ground up, and which modules each may use. This is the only copy of the table: CMakeLists.txt
# builds one library per module from it, and the test modules.IncludesPointDownwardOnly holds the sources to it.
# What a used module may use is open to its user too.
set(LAUNCHSAFE_MODULES math keys materials scene trace mpm surface run store study report kinds)

set(LAUNCHSAFE_math_USES "")
set(LAUNCHSAFE_keys_USES "")
set(LAUNCHSAFE_materials_USES keys math)
set(LAUNCHSAFE_scene_USES materials)
set(LAUNCHSAFE_trace_USES scene)
set(LAUNCHSAFE_mpm_USES materials scene)
set(LAUNCHSAFE_surface_USES materials scene trace)
set(LAUNCHSAFE_run_USES mpm surface trace)
set(LAUNCHSAFE_store_USES run)
set(LAUNCHSAFE_study_USES run store)
set(LAUNCHSAFE_report_USES study store)
set(LAUNCHSAFE_kinds_USES report study)

# The program is no library and nobody may use it.
set(LAUNCHSAFE_app_USES kinds)
