#!/usr/bin/env bash
# enter.sh ROOT COMMAND...: runs COMMAND as root in the Debian root ROOT, the way a fresh machine would.
#
# To be started by "unshare --mount --pid --fork": every mount made here is private to that namespace and vanishes
# with it, so that deleting ROOT afterwards cannot reach the host through a mount left behind.
set -euo pipefail

root=$1
shift

mount -t proc proc "$root/proc"
# Without /sys the environment part of a report has fewer facts; some containers do not allow it.
mount -t sysfs -o ro sysfs "$root/sys" 2>/dev/null || true
mount -t tmpfs -o mode=0755 tmpfs "$root/dev"
for device in null zero full random urandom tty; do
  touch "$root/dev/$device"
  mount --bind "/dev/$device" "$root/dev/$device"
done
mkdir "$root/dev/pts" "$root/dev/shm"
mount -t devpts -o newinstance,ptmxmode=0666,mode=0620 devpts "$root/dev/pts"
mount -t tmpfs -o mode=1777 tmpfs "$root/dev/shm"
ln -s pts/ptmx "$root/dev/ptmx"
ln -s /proc/self/fd "$root/dev/fd"
ln -s fd/0 "$root/dev/stdin"
ln -s fd/1 "$root/dev/stdout"
ln -s fd/2 "$root/dev/stderr"

# Started in the background, the caller's shell had set SIGINT to be ignored; a person's terminal has not.
exec env -i --default-signal=INT,QUIT PATH=/usr/local/sbin:/usr/local/bin:/usr/sbin:/usr/bin:/sbin:/bin \
  TERM="${TERM:-dumb}" LANG=C.UTF-8 chroot "$root" "$@"
