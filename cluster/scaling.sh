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
if [ $# = 0 ]; then
    echo "usage: bash cluster/scaling.sh DIRECTORY [OPTIONS OF tristack crosscheck]" >&2
    exit 1
fi
directory=$(realpath -m "$1")
shift
if [ $# = 0 ]; then
    set -- --profile literal --codes lammps --mu 0.1:0.2:0.02,0.21,0.22 --stiffness 1e3
fi
mkdir "$directory" "$directory/probed"

# Ends the measurement if a command has not ended with rows or properties, whatever their verdicts (statuses 0, 2 and 4). What
# it has said is in the texts of a directory.
check() {
    case $1 in
    0 | 2 | 4) ;;
    *) tail -n 5 -- "$2"/*.txt >&2 && exit "$1" ;;
    esac
}

probe_codes() {
    local codes=() option previous='' status=0
    for option in "$@"; do
        case $previous=$option in
        --codes=*) codes=(--codes "$option") ;;
        *=--codes=*) codes=("$option") ;;
        esac
        previous=$option
    done
    "$tristack" probe --store "$directory/probed" "${codes[@]}" >"$directory/probe.txt" 2>&1 || status=$?
    check "$status" "$directory"
}

# `run_tasks 4 OPTIONS`, in the directory of that number of tasks.
run_tasks() {
    local place=$directory/$1 tasks=$1 task waiting=() status=0
    shift
    if sinfo >/dev/null 2>&1; then
        CROSSCHECK=$place sbatch --wait --array=1-"$tasks" --output="$place/%a.txt" "$here/crosscheck.slurm" "$@" \
            >/dev/null || status=$?
        check "$status" "$place"
        return
    fi
    for ((task = 1; task <= tasks; task++)); do
        "$tristack" crosscheck --store "$place/store" --out "$place/rows/$task" --jobs 1 "$@" >"$place/$task.txt" 2>&1 &
        waiting+=($!)
    done
    for task in "${waiting[@]}"; do
        status=0
        wait "$task" || status=$?
        check "$status" "$place"
    done
}

probe_codes "$@"
printf '%6s %9s %14s\n' tasks seconds 'times as fast'
first=''
for tasks in ${TASKS:-1 2 4}; do
    mkdir "$directory/$tasks"
    cp -r "$directory/probed" "$directory/$tasks/store"
    begin=$(date +%s%3N)
    run_tasks "$tasks" "$@"
    took=$(($(date +%s%3N) - begin))
    first=${first:-$took}
    awk -v tasks="$tasks" -v took="$took" -v first="$first" \
        'BEGIN { printf "%6d %9.1f %14.2f\n", tasks, took / 1000, first / took }'
    for task in "$directory/$tasks"/rows/*; do diff -r "$directory/$tasks/rows/1" "$task"; done
done
echo "the rows of all tasks are the same, byte by byte"
