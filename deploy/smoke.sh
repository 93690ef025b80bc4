#!/usr/bin/env bash
# Runs the image as in the README, requests a model, checks its permissions, and stops it.   smoke.sh <engine> <image>
set -euo pipefail
cd "$(dirname "${BASH_SOURCE[0]}")/.."
engine=$1 image=$2
work=$PWD/build/image
uid=10001

fail() {
  printf 'image: %s\n' "$*" >&2
  if [ "$engine" != buildah ]; then "$engine" logs "$container" >"$work/run.log" 2>&1 || true; fi
  sed 's/^/  /' "$work/run.log" >&2
  exit 1
}
now_ms() { echo $(($(date +%s%N) / 1000000)); }

# --- Running, entering, ending --------------------------------------------------------------------------------------
# start sets `container`, `port`, `begun`, and `process`: the service's number here, empty where the engine runs elsewhere.

start_engine() {
  begun=$(now_ms)
  container=$("$engine" run --detach --read-only --cap-drop ALL --security-opt no-new-privileges --user $uid \
    --publish 127.0.0.1::8080 "$image")
  port=$("$engine" port "$container" 8080 | head -1)
  port=${port##*:}
  process=$("$engine" inspect --format '{{.State.Pid}}' "$container")
  [ -r "/proc/$process/status" ] || process=''
}

# Of the image's configuration: Env, Entrypoint, Cmd; one a line.
configured() { buildah inspect --format "{{range .OCIv1.Config.$1}}{{println .}}{{end}}" "$container" | grep . || true; }

# As near as it gets without a runtime: the image's root mounted read-only in a mount namespace of its own, its variables, its
# command, its user, and no capability. The port is any, since the network is that of the machine.
start_buildah() {
  container=$(buildah from --pull-never "localhost/$image")
  local variables command
  mapfile -t variables < <(configured Env)
  mapfile -t command < <(configured Entrypoint; configured Cmd)
  root=$(buildah mount "$container") user=$(buildah inspect --format '{{.OCIv1.Config.User}}' "$container")
  export root user
  begun=$(now_ms)
  unshare --mount bash -c '
    mount --bind "$root" "$root" && mount --bind /proc "$root/proc" && mount --rbind /dev "$root/dev" &&
      mount -o remount,bind,ro "$root" || exit 125
    exec env -i PATH="$PATH" "${@:2:$1}" setpriv --no-new-privs chroot --userspec="$user" --groups= "$root" "${@:$1+2}"
  ' image $((${#variables[@]} + 1)) "${variables[@]}" SEEDMESH_PORT=0 "${command[@]}" </dev/null >"$work/run.log" 2>&1 &
  process=$!
  port=''
  until [ -n "$port" ]; do
    kill -0 "$process" 2>/dev/null || fail "the service ended at once"
    port=$(sed -n 's/^Listening on .*:\([0-9]*\)$/\1/p' "$work/run.log")
  done
}

# inside <uid> <arguments...>: the program once more, in the running container.
inside() {
  local as=$1; shift
  case $engine in
    buildah)
      SEEDMESH_PORT=$port nsenter --target "$process" --mount --root --setuid "$as" --setgid "$as" /usr/bin/seedmesh "$@" ;;
    *) "$engine" exec --interactive --user "$as" "$container" /usr/bin/seedmesh "$@" ;;
  esac
}

# Asks the service to end; prints its exit status.
end() {
  if [ "$engine" = buildah ]; then
    local status=0
    kill -TERM "$process"
    wait "$process" || status=$?
    echo "$status" >"$work/exit_status"
  else
    "$engine" stop --time 40 "$container" >/dev/null
    "$engine" logs "$container" >"$work/run.log" 2>&1
    "$engine" inspect --format '{{.State.ExitCode}}' "$container" >"$work/exit_status"
  fi
}

clean() {
  [ -n "${container:-}" ] || return 0
  if [ "$engine" != buildah ]; then "$engine" rm --force "$container" >/dev/null; return; fi
  if kill -KILL "${process:-}" 2>/dev/null; then wait "$process" 2>/dev/null || true; fi
  buildah rm "$container" >/dev/null
}
trap clean EXIT

# --- Checks ---------------------------------------------------------------------------------------------------------

passed=0
holds() {  # <sentence> <command...>
  "${@:2}" || fail "not so: $1"
  passed=$((passed + 1))
  printf '  %s\n' "$1"
}

healthy() { curl -fsS --max-time 5 -o /dev/null "http://127.0.0.1:$port/healthz" 2>/dev/null; }
has_status() { grep -qE "^$1:[[:space:]]+$2\$" "/proc/$process/status"; }
has_sound_model() {  # <preset>: a GLB whose header has its length
  local file=$work/model.glb length
  curl -fsS --max-time 30 -o "$file" "http://127.0.0.1:$port/v1/presets/$1.glb?seed=3"
  length=$(od -An -tu4 -j8 -N4 "$file" | tr -d ' ')
  [ "$(head -c 4 "$file")" = glTF ] && [ "$length" = "$(wc -c <"$file" | tr -d ' ')" ]
}
serves_the_page() { curl -fsS "http://127.0.0.1:$port/" | grep '<script' >/dev/null; }
cannot_write() {  # as root, so that nothing but the file system can be what refuses
  local said
  said=$(echo "{\"preset\":\"$1\"}" | inside 0 generate - -o /model.glb 2>&1) || true
  [[ $said == *"Read-only file system"* ]]
}
ends_well() { end; [ "$(cat "$work/exit_status")" = 0 ]; }

: >"$work/run.log"
if [ "$engine" = buildah ]; then start_buildah; else start_engine; fi
until healthy; do
  [ $(($(now_ms) - begun)) -lt 30000 ] || fail "no healthy answer in 30 s"
  sleep 0.01
done
first=$(($(now_ms) - begun))
preset=$(curl -fsS "http://127.0.0.1:$port/v1/presets" | grep -o '"name": *"[^"]*"' | awk -F'"' 'NR == 1 { print $4 }')

holds "says that it is healthy" inside $uid healthcheck --host 127.0.0.1
holds "serves the page" serves_the_page
holds "makes a model of the preset $preset" has_sound_model "$preset"
if [ -n "$process" ]; then
  holds "runs as user $uid" has_status Uid "(${uid}[[:space:]]*){4}"
  holds "has no capability" has_status CapEff 0+
  holds "cannot gain one" has_status NoNewPrivs 1
fi
holds "cannot write to its root" cannot_write "$preset"
holds "ends with 0 after SIGTERM" ends_well

size_of() {
  if [ "$engine" = buildah ]; then buildah images --format '{{.Size}}' "localhost/$image"
  else "$engine" image inspect --format '{{.Size}}' "$image" | awk '{ printf "%.1f MB\n", $1 / 1e6 }'; fi
}
printf 'size %s, first healthy answer after %d ms\n%d passed, 0 failed\n' "$(size_of)" "$first" "$passed"
