"""Starts the three nodes of GeoHTN together, and plans a mission when one is given."""

from __future__ import annotations

from launch.actions import DeclareLaunchArgument, EmitEvent, ExecuteProcess, RegisterEventHandler
from launch.conditions import IfCondition
from launch.event_handlers import OnProcessExit
from launch.events import Shutdown
from launch.substitutions import (
    LaunchConfiguration,
    NotEqualsSubstitution,
    PathJoinSubstitution,
)
from launch_ros.actions import Node
from launch_ros.substitutions import ExecutableInPackage, FindPackageShare

from launch import LaunchDescription, LaunchDescriptionEntity

NODES = ('motion_planner_node', 'task_planner_node', 'interface_node')


def arguments() -> list[DeclareLaunchArgument]:
    """What can be given as NAME:=VALUE."""
    return [
        DeclareLaunchArgument(
            'mission',
            default_value='',
            description='mission to plan once the nodes are up: a folder that holds domain.lisp, '
            'problem.lisp and world.yaml, or the name of an installed mission, for example rover; '
            'empty for none',
        ),
        DeclareLaunchArgument(
            'output',
            default_value='',
            description='folder for plan.json, mission.png and mission.mcap; empty for out/ and '
            'the name of the mission',
        ),
        DeclareLaunchArgument(
            'namespace',
            default_value='',
            description='ROS namespace of the three nodes; one for each team of robots',
        ),
        DeclareLaunchArgument(
            'params_file',
            default_value=PathJoinSubstitution(
                [FindPackageShare('interface_node'), 'config', 'geohtn.yaml']
            ),
            description='YAML file with the parameters of the three nodes',
        ),
        DeclareLaunchArgument(
            'log_level',
            default_value='info',
            choices=['debug', 'info', 'warn', 'error', 'fatal'],
            description='least severity that the nodes log',
        ),
    ]


#: Nodes that were started together wait longer for each other: discovery takes its time.
JUST_STARTED = {'interface_node': [{'peer_timeout': 15.0}]}


def node(name: str) -> Node:
    """One of the three nodes: package and executable have its name."""
    return Node(
        package=name,
        executable=name,
        namespace=LaunchConfiguration('namespace'),
        parameters=[*JUST_STARTED.get(name, ()), LaunchConfiguration('params_file')],
        ros_arguments=['--log-level', LaunchConfiguration('log_level')],
        output='screen',
    )


def stop_with(started: Node) -> RegisterEventHandler:
    """End everything when a node has ended: without it the others are of no use."""
    reason = Shutdown(reason='a node has ended')
    return RegisterEventHandler(
        OnProcessExit(target_action=started, on_exit=EmitEvent(event=reason))
    )


def generate_launch_description() -> LaunchDescription:
    """The three nodes and, with a mission, one `geohtn plan`."""
    nodes = [node(name) for name in NODES]
    planning = ExecuteProcess(
        name='geohtn',
        cmd=[
            ExecutableInPackage(package='interface_node', executable='geohtn'),
            'plan',
            LaunchConfiguration('mission'),
            '--namespace',
            LaunchConfiguration('namespace'),
            '--output',
            LaunchConfiguration('output'),
            '--wait',
            '30',
        ],
        output='screen',
        condition=IfCondition(NotEqualsSubstitution(LaunchConfiguration('mission'), '')),
    )
    entities: list[LaunchDescriptionEntity] = [
        *arguments(),
        *nodes,
        *(stop_with(started) for started in nodes),
        planning,
    ]
    return LaunchDescription(entities)
