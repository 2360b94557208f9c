# What is fuzzed, each for 15 s of the tests: together they must stay within two minutes.
set(fuzzed_readers scene study curve accuracy store)
