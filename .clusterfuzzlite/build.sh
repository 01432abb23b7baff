#!/bin/bash -eu
# Build the programs of fuzz/fuzzers, each with its seeds, regressions and dictionary.
pip3 install .
python3 -m fuzz.seeds "$WORK/seeds"

for program in fuzz/fuzzers/*_fuzzer.py; do
    name=$(basename -s .py "$program")
    target=${name%_fuzzer}
    compile_python_fuzzer "$program" --paths "$PWD"
    if [ -d "fuzz/regressions/$target" ]; then
        cp "fuzz/regressions/$target"/* "$WORK/seeds/$target/"
    fi
    (cd "$WORK/seeds/$target" && zip -q -r "$OUT/${name}_seed_corpus.zip" .)
    read -r dictionary longest < <(python3 -c "
import sys
from fuzz.targets import TARGETS
target = TARGETS[sys.argv[1]]
print(target.dictionary, target.longest)" "$target")
    cp "fuzz/dictionaries/$dictionary.dict" "$OUT/$name.dict"
    printf '[libfuzzer]\nmax_len = %s\n' "$longest" >"$OUT/$name.options"
done
