using System.Collections.Generic;
using System.IO;
using System.IO.Compression;
using System.Text;
using System.Text.RegularExpressions;
using UnityEditor;
using UnityEngine;

namespace Seedmesh.Editor
{
    /// <summary>
    /// Makes a prefab of a scene whose request file has "output": {"format": "placements"}: its models as GLB files in a folder, and
    /// instances of them in their places.
    /// </summary>
    public static class SeedmeshPlacements
    {
        [System.Serializable] class PlacementList { public List<Placement> placements = new List<Placement>(); }

        [System.Serializable]
        class Placement
        {
            public string model = "";
            public float[] translation = { 0, 0, 0 };
            public float[] rotation = { 0, 0, 0, 1 };
            public float[] scale = { 1, 1, 1 };
        }

        public static bool IsWanted(string request) => Regex.IsMatch(request, @"""format""\s*:\s*""placements""");

        /// <summary>Writes models and prefab from the zip file that the service made. `path` is that of the request file.</summary>
        public static void Make(string path, byte[] archive)
        {
            var folder = path.Substring(0, path.Length - Path.GetExtension(path).Length) + "_models";
            Directory.CreateDirectory(folder);
            string list = "";
            using (var zip = new ZipArchive(new MemoryStream(archive), ZipArchiveMode.Read))
            {
                foreach (var entry in zip.Entries)
                {
                    using (var stream = entry.Open())
                    using (var bytes = new MemoryStream())
                    {
                        stream.CopyTo(bytes);
                        if (entry.FullName == "placements.json") list = Encoding.UTF8.GetString(bytes.ToArray());
                        else File.WriteAllBytes(Path.Combine(folder, entry.Name), bytes.ToArray());
                    }
                }
            }
            AssetDatabase.Refresh();
            var root = new GameObject(Path.GetFileNameWithoutExtension(path));
            foreach (var each in JsonUtility.FromJson<PlacementList>(list).placements) Add(root, folder, each);
            PrefabUtility.SaveAsPrefabAsset(root, Path.ChangeExtension(path, ".prefab"));
            Object.DestroyImmediate(root);
        }

        /// <summary>glTFast turns the right-handed axes of glTF into Unity's by the opposite X, so places are turned in the same way.</summary>
        static void Add(GameObject root, string folder, Placement placement)
        {
            var model = AssetDatabase.LoadAssetAtPath<GameObject>($"{folder}/{placement.model}.glb");
            if (model == null) return;
            var copy = (GameObject)PrefabUtility.InstantiatePrefab(model, root.transform);
            float[] t = placement.translation, r = placement.rotation, s = placement.scale;
            copy.transform.localPosition = new Vector3(-t[0], t[1], t[2]);
            copy.transform.localRotation = new Quaternion(r[0], -r[1], -r[2], r[3]);
            copy.transform.localScale = new Vector3(s[0], s[1], s[2]);
        }
    }
}
