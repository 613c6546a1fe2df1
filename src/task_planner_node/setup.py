from pathlib import Path

from setuptools import find_packages, setup

package_name = 'task_planner_node'
domains = sorted(path for path in Path('domains').rglob('*') if path.is_file())

setup(
    name=package_name,
    version='0.1.0',
    packages=find_packages(exclude=['test', 'test.*']),
    package_data={package_name: ['py.typed']},
    data_files=[
        ('share/ament_index/resource_index/packages', ['resource/' + package_name]),
        ('share/' + package_name, ['package.xml']),
        *((f'share/{package_name}/{path.parent}', [str(path)]) for path in domains),
    ],
    zip_safe=False,
    license='Apache-2.0',
    entry_points={'console_scripts': [f'{package_name} = {package_name}.__main__:main']},
)
