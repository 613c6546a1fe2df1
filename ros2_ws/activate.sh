# Source this in bash or zsh: puts ROS 2, the three nodes and `geohtn` into the environment.
#     . ros2_ws/activate.sh
_geohtn_ws=$(cd "$(dirname "${BASH_SOURCE[0]:-$0}")" && pwd -P)
if [ ! -f "$_geohtn_ws/install/set_up.stamp" ] || [ ! -f "$_geohtn_ws/../.venv/environment.sh" ]; then
  echo "GeoHTN is not set up yet: run make setup in $(dirname "$_geohtn_ws") first." >&2
  return 2
fi
. "$_geohtn_ws/../.venv/environment.sh" || return 2
if [ -n "${ZSH_VERSION:-}" ]; then
  . "$_geohtn_ws/install/local_setup.zsh"
else
  . "$_geohtn_ws/install/local_setup.bash"
fi
unset _geohtn_ws
