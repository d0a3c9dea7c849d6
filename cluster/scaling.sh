#!/bin/bash
# Measures how long 1, 2 and 4 tasks take for one crosscheck, each time with a new store:
#
#     bash cluster/scaling.sh DIRECTORY [OPTIONS OF tristack crosscheck]
#
# With Slurm the tasks are an array of cluster/crosscheck.slurm; without, processes of this machine. The codes are probed
# beforehand, because a probe is one piece of work. DIRECTORY must be new, and seen by all nodes. TASKS="1 8 64" measures other
# numbers of tasks. Without options it takes eight stacks of the literal figure with LAMMPS, three minutes of one core.
set -euo pipefail
here=$(cd "$(dirname "$0")" && pwd)
tristack=${TRISTACK:-tristack}
directory=$(realpath -m "${1:?a new directory}")
shift
if [ $# = 0 ]; then
    set -- --profile literal --codes lammps --mu 0.1:0.2:0.02,0.21,0.22 --stiffness 1e3
fi
mkdir "$directory"
cd "$directory"
probed=$directory/probed

probe_codes() {
    local previous='' option
    for option in "$@"; do
        [ "$previous" != --codes ] || "$tristack" probe --codes "$option" --store "$probed" >probe.txt 2>&1
        previous=$option
    done
}

# Ends the measurement if a task has not ended with rows, whatever their verdicts (statuses 0, 2 and 4).
check() {
    case $1 in
    0 | 2 | 4) ;;
    *) tail -n 5 -- *.txt >&2 && exit "$1" ;;
    esac
}

run_tasks() {
    local tasks=$1 task waiting=() status=0
    shift
    if sinfo >sinfo.txt 2>&1; then
        CROSSCHECK=$directory/$tasks sbatch --wait --array=1-"$tasks" --output=%a.txt "$here/crosscheck.slurm" "$@" \
            >sbatch.txt || status=$?
        check "$status"
        return
    fi
    for ((task = 1; task <= tasks; task++)); do
        "$tristack" crosscheck --store "$store" --out "$directory/$tasks/rows/$task" --jobs 1 "$@" >"$task.txt" 2>&1 &
        waiting+=($!)
    done
    for task in "${waiting[@]}"; do
        status=0
        wait "$task" || status=$?
        check "$status"
    done
}

mkdir "$probed"
probe_codes "$@"
printf '%6s %9s %14s\n' tasks seconds 'times as fast'
first=''
for tasks in ${TASKS:-1 2 4}; do
    store=$directory/$tasks/store
    mkdir "$tasks"
    cp -r "$probed" "$store"
    pushd "$tasks" >/dev/null
    begin=$(date +%s%3N)
    run_tasks "$tasks" "$@"
    took=$(($(date +%s%3N) - begin))
    first=${first:-$took}
    awk -v tasks="$tasks" -v took="$took" -v first="$first" \
        'BEGIN { printf "%6d %9.1f %14.2f\n", tasks, took / 1000, first / took }'
    for task in rows/*; do diff -r rows/1 "$task"; done
    popd >/dev/null
done
echo "the rows of all tasks are the same, byte by byte"
