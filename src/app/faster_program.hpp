// An installation holds the same program for several kinds of processor.
#pragma once

namespace launchsafe::app {

/// Where the build was made to choose (LAUNCHSAFE_CHOOSES_PROGRAM) and a program for wider vectors is
/// installed that this processor runs, that one takes over and this does not return. Which one computes is in
/// `launchsafe --version` and in every manifest. LAUNCHSAFE_ARCHITECTURE in the environment, one of x86-64,
/// x86-64-v3 and x86-64-v4, limits the choice: results of several processors then agree to the last digit.
void become_faster_program(char** arguments);

}  // namespace launchsafe::app
