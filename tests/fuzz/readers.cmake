# What is fuzzed, each for 15 s of the tests.
set(fuzzed_readers scene study curve)
