#!/usr/bin/env bash
# Makes what the tests of faults read, once for all of them, in the folder FAULT_INPUTS.
inputs=${FAULT_INPUTS:?is the folder to make}
rm -rf "$inputs"
. "$(dirname "$0")/lib.sh"
. "$here/inputs.sh"
[ "$failures" -eq 0 ] && cp -r in "$inputs"
finish
