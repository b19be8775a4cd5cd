#!/usr/bin/env bash
# Many seeds: the same table for any number of threads, as text, JSON and CSV; variation of the organ.
# Needs JSON_CHECK (json_check) and SCHEMAS (resources/schemas).
. "$(dirname "$0")/lib.sh"

options=(--organ right-lung --method centroid --points 3000 --set jitter=0.3)
succeeds "a study" study "${options[@]}" --seeds 3 -o table.csv
prints '^seed +N +T +Q_f'
prints '^quantity +mean +SD'
expect "the table does not hold three seeds" test "$(wc -l <table.csv)" -eq 4
succeeds "a study with one thread" study "${options[@]}" --seeds 1..3 -j 1 -o one.csv -q
expect "1 and 2 threads give different tables" cmp table.csv one.csv
succeeds "a study as JSON" study "${options[@]}" --seeds 4..5 --json
expect "the JSON breaks study" "$JSON_CHECK" "$SCHEMAS/study.schema.json" "$logs/out"
succeeds "a varied study" study "${options[@]}" --seeds 3 --vary organ-scale=0.05 --vary trunk-turn=1deg -o varied.csv -q
expect "nothing varies" test "$(cmp -s table.csv varied.csv; echo $?)" -eq 1
succeeds "a varied growth" grow "${options[@]}" --vary organ-scale=0.1 -o varied.vtp --json
prints '"organ-scale": 0.1'

refuses "no organ" 2 "study needs lobe surfaces" study --seeds 3
refuses "no seeds" 2 "seeds.*'0'" study "${options[@]}" --seeds 0
refuses "seeds backwards" 2 "seeds.*'5\.\.2'" study "${options[@]}" --seeds 5..2
refuses "seeds that are no number" 2 "seeds.*'few'" study "${options[@]}" --seeds few
refuses "too many seeds" 2 "seeds.*10000" study "${options[@]}" --seeds 10001
refuses "an unknown variation" 2 "'trunk-tur'.*did you mean 'trunk-turn'" study "${options[@]}" --vary trunk-tur=5
refuses "a variation out of range" 2 "organ-scale.*\[0, 0.3\].*3" grow "${options[@]}" --vary organ-scale=3 -o t.vtp
refuses "a variation without a value" 2 "--vary needs key=value.*'trunk-turn'" study "${options[@]}" --vary trunk-turn
refuses "a study onto a file" 6 "table.csv.*exists" study "${options[@]}" --seeds 2 -o table.csv
refuses "a study that is no table" 5 "s.json.*csv" study "${options[@]}" --seeds 2 -o s.json
finish
