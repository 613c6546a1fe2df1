from setuptools import setup

package_name = 'geohtn_example_functions'

setup(
    name=package_name,
    version='0.1.0',
    packages=[package_name],
    data_files=[
        ('share/ament_index/resource_index/packages', ['resource/' + package_name]),
        ('share/' + package_name, ['package.xml']),
    ],
    zip_safe=False,
    license='Apache-2.0',
    entry_points={'motion_planner_node.functions': [f'example = {package_name}:FUNCTIONS']},
)
