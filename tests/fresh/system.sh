# SPDX-License-Identifier: GPL-3.0-or-later
# Sourced by tests/fresh/check.sh: how a bare Debian is made, kept, entered and spoken to. Runs in
# namespaces of its own, so that whatever is mounted here is gone with the last process.
# Needs `release`, `work` (a folder to be removed, with sources.list, index, argil), `cache` and `log`.

# What a system is made of: the archive's state and this recipe. A system is kept for as long as both
# stay as they are, so that a new point release or security update makes a new one.
system_key() { cat "$work"/index/* tests/fresh/system.sh "$@" | sha256sum | cut -c 1-16; }

# keep NAME KEY SYSTEM: its files without those that are mounted or downloaded.
keep_system() {
  rm -f "$cache/$1"-*.tar
  tar -C "$3" -cf "$cache/$1.part" --numeric-owner --one-file-system --exclude='./dev/*' \
    --exclude='./proc/*' --exclude='./sys/*' --exclude='./var/cache/apt/archives/*' \
    --exclude='./var/lib/apt/lists/*' --exclude='./root/*' .
  mv "$cache/$1.part" "$cache/$1-$2.tar"
}

# kept_system NAME KEY SYSTEM: false when there is none.
kept_system() {
  [ -s "$cache/$1-$2.tar" ] || return 1
  mkdir -p "$3"
  tar -C "$3" -xf "$cache/$1-$2.tar" --numeric-owner
}

# put_in_memory SYSTEM MB: a small system on a machine with much memory, where unpacking and removing
# some 60 000 files would wait for the disk. It goes with the namespace.
put_in_memory() {
  local free limit
  free=$(awk '/^MemAvailable:/ { print int($2 / 1024) }' /proc/meminfo)
  limit=$(awk '/^[0-9]/ { print int($1 / 1048576) }' /sys/fs/cgroup/memory.max 2>/dev/null || true)
  # Besides it, compilers need some 3 GB, and tests beside this one as much again.
  ((free >= $2 + 6000 && ${limit:-$free} >= $2 + 6000)) || return 0
  mkdir -p "$1"
  mount -t tmpfs -o "size=$2m,mode=755" tmpfs "$1"
}

# Essential packages and apt. Without force-unsafe-io dpkg waits for the disk after each of thousands
# of files, so that a power cut harms no system; this one is thrown away.
make_system() { # SYSTEM
  local key proxy status=0
  key=$(system_key)
  ! kept_system bare "$key" "$1" || return 0
  proxy=$(apt-config dump --format '%v' Acquire::http::Proxy)
  run_logged "$log/bootstrap.log" mmdebstrap --variant=apt --mode=root --verbose \
    --dpkgopt=force-unsafe-io ${proxy:+"--aptopt=Acquire::http::Proxy \"$proxy\""} \
    --skip=essential/unlink,cleanup/apt/cache \
    --setup-hook="mkdir -p \"\$1/var/cache/apt/archives\"" \
    --setup-hook="mount --bind '$cache/archives' \"\$1/var/cache/apt/archives\"" \
    "$release" "$1" "$work/sources.list" || status=$?
  if grep -qE 'NO_PUBKEY|Missing key' "$log/bootstrap.log"; then
    complain "cannot run here: the keys of this system do not know $release" \
      "remedy: as root, apt-get install debian-archive-keyring"
    exit 77
  fi
  [ $status -eq 0 ] || return 1
  keep_system bare "$key" "$1"
}

# What a running machine has and a folder has not. No service is started: these would be the host's
# ports.
enter_system() { # SYSTEM
  local dev=$1/dev node
  mountpoint -q "$1/var/cache/apt/archives" || mount --bind "$cache/archives" "$1/var/cache/apt/archives"
  mount -t proc proc "$1/proc"
  mount --rbind /sys "$1/sys"
  mount -t tmpfs -o mode=755 tmpfs "$dev"
  for node in null zero full random urandom tty; do
    : >"$dev/$node"
    mount --bind "/dev/$node" "$dev/$node"
  done
  mkdir "$dev/pts" "$dev/shm"
  mount -t devpts -o newinstance,ptmxmode=666,mode=620 devpts "$dev/pts"
  mount -t tmpfs -o mode=1777 tmpfs "$dev/shm"
  ln -s pts/ptmx "$dev/ptmx"
  ln -s /proc/self/fd "$dev/fd"
  ln -s fd/0 "$dev/stdin"
  ln -s fd/1 "$dev/stdout"
  ln -s fd/2 "$dev/stderr"
  cp /etc/resolv.conf /etc/hosts "$1/etc/"
  printf '#!/bin/sh\nexit 101\n' >"$1/usr/sbin/policy-rc.d"
  chmod 755 "$1/usr/sbin/policy-rc.d"
}

# in_clone SYSTEM CLONE COMMAND: as root types it there, with nothing of the environment here.
in_clone() {
  chroot "$1" /usr/bin/env -i HOME=/root USER=root LANG=C.UTF-8 TERM=dumb ARGIL_FRESH_INSIDE=1 \
    PATH=/usr/local/sbin:/usr/local/bin:/usr/sbin:/usr/bin:/sbin:/bin \
    ${http_proxy:+"http_proxy=$http_proxy"} ${ARGIL_JOBS:+"ARGIL_JOBS=$ARGIL_JOBS"} \
    bash -c 'cd "$0" && eval "$1"' "$2" "$3"
}

put_clone() { # SYSTEM CLONE: a clone of HEAD, and the meshes that are shared beside it
  mkdir -p "$1$2"
  cp -R "$work/argil/." "$1$2/"
  [ ! -d "$work/shared" ] || cp -R "$work/shared" "$(dirname "$1$2")/shared"
}

# The compiler's cache, where what is shown is not how long compiling takes.
put_ccache() { # SYSTEM
  mkdir -p "$1/root/.cache/ccache"
  mount --bind "$cache/ccache" "$1/root/.cache/ccache"
}
