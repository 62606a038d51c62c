#!/bin/sh
# Make the operator's token at the first start and run a command that has it in its environment.
# Usage: with-token.sh COMMAND [ARGUMENT …]
# The token lies in $PONS_HOME/operator.token, for this user alone. It is never printed.
set -eu
: "${PONS_HOME:?with-token.sh needs PONS_HOME}"
file=$PONS_HOME/operator.token
if [ ! -s "$file" ]; then
  new=$file.$$
  (umask 077 && od -An -N24 -tx1 /dev/urandom | tr -d ' \n' >"$new")
  # A link is made by one only, should two start at once.
  ln "$new" "$file" 2>/dev/null && echo "pons: made the operator's token in $file" >&2
  rm -f "$new"
fi
PONS_OPERATOR_TOKEN=$(cat "$file")
export PONS_OPERATOR_TOKEN
exec "$@"
