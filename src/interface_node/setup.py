from pathlib import Path

from setuptools import find_packages, setup

package_name = 'interface_node'


def installed(folder: str) -> list[tuple[str, list[str]]]:
    """Every file below ``folder``, to be installed below the package's share directory."""
    files = sorted(path for path in Path(folder).rglob('*') if path.is_file())
    return [
        (f'share/{package_name}/{path.parent}', [str(path)])
        for path in files
        if '__pycache__' not in path.parts
    ]


setup(
    name=package_name,
    version='0.1.0',
    packages=find_packages(exclude=['test', 'test.*']),
    package_data={package_name: ['py.typed']},
    data_files=[
        ('share/ament_index/resource_index/packages', ['resource/' + package_name]),
        ('share/' + package_name, ['package.xml']),
        *installed('missions'),
        *installed('launch'),
        *installed('config'),
        *installed('rviz'),
        ('bin', ['bin/geohtn']),
    ],
    zip_safe=False,
    license='Apache-2.0',
    entry_points={
        'console_scripts': [
            f'{package_name} = {package_name}.__main__:main',
            f'geohtn = {package_name}.command_line.main:main',
        ]
    },
)
