#!/usr/bin/env bash
# A sweep by GNU parallel, here and through ssh: the table is that of one run, byte for byte.
#   tests/cluster/parallel.sh PROGRAM [SWEEP]      needs: parallel; for the second part sshd and ssh-keygen
# The ssh server is one of this script's own, on a port of its own, with keys made for it; nothing of the system's
# configuration is read or changed.
set -euo pipefail
here="$(cd "$(dirname "$0")" && pwd)"
program="$(realpath "$1")"
sweep="$(realpath "${2:-$here/tiny.toml}")"
folder="$(mktemp -d)"
sshd_pid=""
clean() {
    [ -z "$sshd_pid" ] || kill "$sshd_pid" 2>/dev/null || true
    rm -rf "$folder"
}
trap clean EXIT
cd "$folder"
same() { cmp "$1/table.csv" single/table.csv && echo "same: $2"; }

"$program" sweep "$sweep" --out single --threads 1 >/dev/null
echo "single run: $(($(wc -l <single/table.csv) - 1)) cases"

"$here/by_parallel.sh" "$program" "$sweep" chains --jobs 2 >/dev/null
same chains "a task for each chain, in one folder, collected"

parallel --jobs 3 -N0 "$program" sweep "$sweep" --out shared --resume --threads 1 ::: 1 2 3 4 >/dev/null
same shared "four processes in one folder, each takes what nobody has; the last one made the table"

parallel --jobs 2 "$program" sweep "$sweep" --chain {} --out parts/{} --threads 1 ::: 0-2 3,4,5 6 7 >/dev/null
"$program" sweep collect parts/* --out merged >/dev/null
same merged "parts in folders of their own, collected"

# A part that was lost is named, and redone.
rm -r parts/6
if "$program" sweep collect parts/* --out after >/dev/null 2>message; then
    echo "a missing part was not noticed"
    exit 1
fi
grep -q 'missing: chain 6' message
"$program" sweep "$sweep" --chain 6 --out parts/6 --threads 1 >/dev/null
"$program" sweep collect parts/* --out after >/dev/null
same after "a lost part, named and redone"

if [ ! -x /usr/sbin/sshd ]; then
    echo "no sshd: the part through ssh is left out"
    exit 0
fi
ssh-keygen -q -t ed25519 -N '' -f host_key
ssh-keygen -q -t ed25519 -N '' -f user_key
cp user_key.pub authorized_keys
chmod 600 authorized_keys
port=$((20000 + RANDOM % 20000))
cat >sshd_config <<END
Port $port
ListenAddress 127.0.0.1
HostKey $folder/host_key
AuthorizedKeysFile $folder/authorized_keys
PidFile $folder/sshd.pid
PasswordAuthentication no
PermitRootLogin yes
StrictModes no
UsePAM no
END
mkdir -p /run/sshd 2>/dev/null || true
/usr/sbin/sshd -D -f sshd_config -E sshd.log &
sshd_pid=$!
for _ in $(seq 50); do
    ssh-keyscan -p "$port" 127.0.0.1 2>/dev/null >known_hosts && [ -s known_hosts ] && break
    sleep 0.1
done
login="ssh -p $port -i $folder/user_key -o UserKnownHostsFile=$folder/known_hosts -o BatchMode=yes 127.0.0.1"
"$here/by_parallel.sh" "$program" "$sweep" "$folder/over_ssh" --jobs 2 --sshlogin "$login" >/dev/null
same over_ssh "a task for each chain through ssh, collected"
