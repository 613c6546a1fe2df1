from setuptools import find_packages, setup

package_name = 'motion_planner_node'

setup(
    name=package_name,
    version='0.1.0',
    packages=find_packages(exclude=['test', 'test.*']),
    package_data={package_name: ['py.typed', '**/*.lark']},
    data_files=[
        ('share/ament_index/resource_index/packages', ['resource/' + package_name]),
        ('share/' + package_name, ['package.xml']),
    ],
    zip_safe=False,
    license='Apache-2.0',
    entry_points={'console_scripts': [f'{package_name} = {package_name}.__main__:main']},
)
